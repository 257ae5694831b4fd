//! The language of measures: arithmetic on coordinates of joints. Only the operations listed here are executed.

use super::frame::Frame;
use super::named_measures::{NAMED, Unit};
use crate::humanoid::Role;
use crate::math::float_funcs::double;
use thiserror::Error;

/// Most characters in an expression.
const MAX_CHARS: usize = 200;
/// Most levels of parentheses, calls and signs.
const MAX_DEPTH: usize = 24;

/// A fault in an expression, and its position.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("column {column}: {fault}")]
pub struct ExpressionError {
    /// Position of the fault in characters; the first is 1.
    pub column: usize,
    /// The fault.
    pub fault: Fault,
}

/// A fault at a character.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum Fault {
    /// Unexpected token.
    #[error("{found}; {expected} was expected")]
    Unexpected {
        /// The token.
        found: String,
        /// Tokens that are allowed there.
        expected: &'static str,
    },
    /// No joint, measure or function has this name.
    #[error("there is no joint, measure or function '{0}'")]
    Unknown(String),
    /// A joint is used without a coordinate.
    #[error("'{0}' is a joint; one of its coordinates, '{0}.x', '.y' or '.z', was expected")]
    NoCoordinate(String),
    /// Too long, or too deeply nested.
    #[error("the expression is too {0}")]
    TooLarge(&'static str),
}

/// A function or an operator of two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Min,
    Max,
    Atan2,
}

/// A function or an operator of a single value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unary {
    Negate,
    Abs,
    Sqrt,
}

/// A parsed expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    Number(f64),
    /// A joint's x, y or z.
    Coordinate(Role, usize),
    /// One of [`NAMED`].
    Named(usize),
    Unary(Unary, Box<Node>),
    Binary(Binary, Box<[Node; 2]>),
}

impl Node {
    pub(super) fn value(&self, frame: &Frame) -> f64 {
        match self {
            Self::Number(value) => *value,
            Self::Coordinate(role, axis) => 100.0 * f64::from(frame.positions[role.index()].to_array()[*axis]),
            Self::Named(index) => (NAMED[*index].of)(frame),
            Self::Unary(function, of) => {
                let value = of.value(frame);
                match function {
                    Unary::Negate => -value,
                    Unary::Abs => value.abs(),
                    Unary::Sqrt => value.sqrt(),
                }
            }
            Self::Binary(function, of) => {
                let [a, b] = [of[0].value(frame), of[1].value(frame)];
                match function {
                    Binary::Add => a + b,
                    Binary::Subtract => a - b,
                    Binary::Multiply => a * b,
                    Binary::Divide => a / b,
                    Binary::Min => a.min(b),
                    Binary::Max => a.max(b),
                    Binary::Atan2 => double::atan2(a, b).to_degrees(),
                }
            }
        }
    }

    /// The unit of the value; sums of different units have none.
    pub(super) fn unit(&self) -> Unit {
        let powers = |[a, b]: [Unit; 2], sign: i8| Unit {
            cm: a.cm.saturating_add(b.cm.saturating_mul(sign)),
            deg: a.deg.saturating_add(b.deg.saturating_mul(sign)),
            secs: a.secs.saturating_add(b.secs.saturating_mul(sign)),
        };
        match self {
            Self::Number(_) => Unit::default(),
            Self::Coordinate(..) => Unit::CM,
            Self::Named(index) => NAMED[*index].unit,
            Self::Unary(Unary::Sqrt, of) => {
                let Unit { cm, deg, secs } = of.unit();
                if [cm, deg, secs].iter().all(|p| p % 2 == 0) {
                    Unit { cm: cm / 2, deg: deg / 2, secs: secs / 2 }
                } else {
                    Unit::default()
                }
            }
            Self::Unary(_, of) => of.unit(),
            Self::Binary(function, of) => {
                let units = [of[0].unit(), of[1].unit()];
                match function {
                    Binary::Multiply => powers(units, 1),
                    Binary::Divide => powers(units, -1),
                    Binary::Atan2 => Unit::DEG,
                    // A bare number takes the unit of the other operand.
                    _ if units[0] == units[1] || matches!(of[1], Self::Number(_)) => units[0],
                    _ if matches!(of[0], Self::Number(_)) => units[1],
                    _ => Unit::default(),
                }
            }
        }
    }
}

/// Parses an expression.
pub(super) fn parse(text: &str) -> Result<Node, ExpressionError> {
    let mut parser = Parser::new(text);
    let node = parser.expression()?;
    parser.peek().map_or(Ok(node), |_| Err(parser.unexpected("an operator or the end")))
}

/// Parses a list of expressions, with their texts.
pub(super) fn parse_list(text: &str) -> Result<Vec<(&str, Node)>, ExpressionError> {
    let mut parser = Parser::new(text);
    let mut nodes = Vec::new();
    loop {
        let begin = parser.at;
        let node = parser.expression()?;
        nodes.push((&text[begin..parser.at], node));
        match parser.peek() {
            Some(',') => parser.at += 1,
            Some(_) => return Err(parser.unexpected("an operator, a comma or the end")),
            None => return Ok(nodes),
        }
    }
}

/// Recursive-descent parser of a text.
struct Parser<'a> {
    text: &'a str,
    /// Number of bytes consumed.
    at: usize,
    depth: usize,
    /// Start of the current expression, bytes.
    begin: usize,
}

impl<'a> Parser<'a> {
    fn new(text: &'a str) -> Self {
        Self { text, at: 0, depth: 0, begin: 0 }
    }

    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// The next character that is not a space.
    fn peek(&mut self) -> Option<char> {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
        self.rest().chars().next()
    }

    fn fault_at(&self, at: usize, fault: Fault) -> ExpressionError {
        ExpressionError { column: self.text[..at].chars().count() + 1, fault }
    }

    fn unexpected(&mut self, expected: &'static str) -> ExpressionError {
        let found = self.peek().map_or_else(|| "the end".to_owned(), |c| format!("'{c}'"));
        self.fault_at(self.at, Fault::Unexpected { found, expected })
    }

    /// Consumes a character if it is the next one.
    fn takes(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    fn expect(&mut self, wanted: char, expected: &'static str) -> Result<(), ExpressionError> {
        if self.takes(wanted) { Ok(()) } else { Err(self.unexpected(expected)) }
    }

    /// Consumes the longest prefix of the rest whose characters satisfy a predicate.
    fn word(&mut self, is_of_kind: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let word = &rest[..rest.find(|c| !is_of_kind(c)).unwrap_or(rest.len())];
        self.at += word.len();
        word
    }

    /// Parses a whole expression.
    fn expression(&mut self) -> Result<Node, ExpressionError> {
        (self.begin, self.depth) = (self.at, 0);
        self.sum()
    }

    fn sum(&mut self) -> Result<Node, ExpressionError> {
        let mut sum = self.product()?;
        loop {
            let function = match self.peek() {
                Some('+') => Binary::Add,
                Some('-') => Binary::Subtract,
                _ => return Ok(sum),
            };
            self.at += 1;
            sum = Node::Binary(function, Box::new([sum, self.product()?]));
        }
    }

    fn product(&mut self) -> Result<Node, ExpressionError> {
        let mut product = self.operand()?;
        loop {
            let function = match self.peek() {
                Some('*') => Binary::Multiply,
                Some('/') => Binary::Divide,
                _ => return Ok(product),
            };
            self.at += 1;
            product = Node::Binary(function, Box::new([product, self.operand()?]));
        }
    }

    fn operand(&mut self) -> Result<Node, ExpressionError> {
        let next = self.peek();
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self.fault_at(self.at, Fault::TooLarge("deeply nested")));
        }
        if self.text[self.begin..self.at].chars().count() > MAX_CHARS {
            return Err(self.fault_at(self.at, Fault::TooLarge("long")));
        }
        let node = match next {
            Some('-') => {
                self.at += 1;
                Node::Unary(Unary::Negate, Box::new(self.operand()?))
            }
            Some('(') => {
                self.at += 1;
                let node = self.sum()?;
                self.expect(')', "an operator or ')'")?;
                node
            }
            Some('0'..='9' | '.') => self.number()?,
            Some(c) if c.is_alphabetic() || c == '_' => self.named()?,
            _ => return Err(self.unexpected("a number, a joint's coordinate, a measure, a function or '('")),
        };
        self.depth -= 1;
        Ok(node)
    }

    fn number(&mut self) -> Result<Node, ExpressionError> {
        let begin = self.at;
        let word = self.word(|c| c.is_ascii_digit() || c == '.');
        let value = word.parse().ok().filter(|v: &f64| v.is_finite());
        value.map(Node::Number).ok_or_else(|| {
            self.fault_at(begin, Fault::Unexpected { found: format!("'{word}'"), expected: "a number such as 1.5" })
        })
    }

    /// Parses a coordinate, a measure, or a function with its arguments.
    fn named(&mut self) -> Result<Node, ExpressionError> {
        let begin = self.at;
        let name = self.word(|c| c.is_alphanumeric() || c == '_');
        if let Some(index) = NAMED.iter().position(|m| m.name == name) {
            return Ok(Node::Named(index));
        }
        if let Some(role) = joint(name) {
            if !self.takes('.') {
                return Err(self.fault_at(begin, Fault::NoCoordinate(name.to_owned())));
            }
            let axis = self.peek().and_then(|c| "xyz".find(c));
            let axis = axis.ok_or_else(|| self.unexpected("x, y or z"))?;
            self.at += 1;
            return match self.rest().chars().next() {
                Some(c) if c.is_alphanumeric() || c == '_' || c == '.' => {
                    Err(self.unexpected("an operator or the end"))
                }
                _ => Ok(Node::Coordinate(role, axis)),
            };
        }
        let unary = match name {
            "abs" => Some(Unary::Abs),
            "sqrt" => Some(Unary::Sqrt),
            _ => None,
        };
        let binary = match name {
            "min" => Some(Binary::Min),
            "max" => Some(Binary::Max),
            "atan2" => Some(Binary::Atan2),
            _ => None,
        };
        if unary.is_none() && binary.is_none() {
            return Err(self.fault_at(begin, Fault::Unknown(name.to_owned())));
        }
        self.expect('(', "'('")?;
        let first = self.sum()?;
        let node = match (unary, binary) {
            (_, Some(function)) => {
                self.expect(',', "an operator or a comma and a second value")?;
                Node::Binary(function, Box::new([first, self.sum()?]))
            }
            (Some(function), None) => Node::Unary(function, Box::new(first)),
            (None, None) => first,
        };
        self.expect(')', "an operator or ')'")?;
        Ok(node)
    }
}

/// The joint of a role's name, which may have its side as a suffix: `hand_l`.
fn joint(name: &str) -> Option<Role> {
    let is_named = |role: &&Role| {
        let full = role.name();
        full == name
            || [("left_", "_l"), ("right_", "_r")].iter().any(|(before, after)| {
                full.strip_prefix(before).is_some_and(|stem| name.strip_suffix(after) == Some(stem))
            })
    };
    Role::ALL.iter().find(is_named).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::humanoid::{Pose, Proportions};
    use proptest::prelude::*;

    /// The T-pose: hands 62.6 cm to either side, 136.4 cm high.
    fn frame() -> Frame {
        Frame::new(&Proportions::default(), &Pose::default(), 1.2)
    }

    fn value(text: &str) -> f64 {
        parse(text).unwrap_or_else(|e| panic!("{text}: {e}")).value(&frame())
    }

    fn fault(text: &str) -> (usize, String) {
        let error = parse(text).unwrap_err();
        (error.column, error.fault.to_string())
    }

    #[test]
    fn arithmetic_is_as_usual() {
        for (text, expected) in [
            ("1 + 2 * 3", 7.0),
            ("(1 + 2) * 3", 9.0),
            ("8 - 4 - 2", 2.0),
            ("8 / 4 / 2", 1.0),
            ("-2 * -3", 6.0),
            ("--2", 2.0),
            ("abs(2 - 5) + min(1, 2) * max(.5, 2)", 5.0),
            ("sqrt(16)", 4.0),
            ("atan2(1, 1)", 45.0),
        ] {
            assert!((value(text) - expected).abs() < 1e-12, "{text}");
        }
    }

    #[test]
    fn coordinates_are_centimetres_left_up_and_forward() {
        let apart = value("hand_l.x - hand_r.x");
        assert!((apart - value("left_hand.x-right_hand.x")).abs() < 1e-9 && (120.0..150.0).contains(&apart), "{apart}");
        assert!((value("hips.y") - 94.1).abs() < 1e-4 && value("hips.x") == 0.0);
        assert!(value("toes_l.z") > value("foot_l.z"));
        assert_eq!(value("hips_height + 1"), value("hips.y + 1"));
        assert!((value("speed") - 120.0).abs() < 1e-4);
    }

    #[test]
    fn units_follow_the_arithmetic() {
        for (text, unit) in [
            ("hand_l.y - shoulder_l.y", "cm"),
            ("2 * hips_height - 10", "cm"),
            ("sqrt(hand_l.x * hand_l.x + hand_l.z * hand_l.z)", "cm"),
            ("hand_l.x * hand_l.z", "cm²"),
            ("hand_l.y / hips.y", ""),
            ("atan2(hand_l.x, hand_l.y) - torso_lean", "°"),
            ("speed", "cm/s"),
            ("hips.y + torso_lean", ""),
        ] {
            assert_eq!(parse(text).unwrap().unit().to_string(), unit, "{text}");
        }
    }

    #[test]
    fn errors_point_at_the_character() {
        for (text, column, sentence) in [
            ("hand_l.y - sholder_l.y", 12, "there is no joint, measure or function 'sholder_l'"),
            ("hand_l - 1", 1, "'hand_l' is a joint; one of its coordinates, 'hand_l.x', '.y' or '.z', was expected"),
            ("hand_l.w", 8, "'w'; x, y or z was expected"),
            ("hand_l.yy", 9, "'y'; an operator or the end was expected"),
            ("(1 + 2", 7, "the end; an operator or ')' was expected"),
            ("1 + ", 5, "the end; a number, a joint's coordinate, a measure, a function or '(' was expected"),
            ("1 2", 3, "'2'; an operator or the end was expected"),
            ("max(1)", 6, "')'; an operator or a comma and a second value was expected"),
            ("1.2.3", 1, "'1.2.3'; a number such as 1.5 was expected"),
            ("1 + hüfte.y", 5, "there is no joint, measure or function 'hüfte'"),
            ("(hüfte", 2, "there is no joint, measure or function 'hüfte'"),
            ("1 + “", 5, "'“'; a number, a joint's coordinate"),
            ("", 1, "the end; a number"),
        ] {
            let (found, reason) = fault(text);
            assert!(found == column && reason.starts_with(sentence), "{text}: column {found}: {reason}");
        }
    }

    #[test]
    fn a_list_is_cut_at_its_own_commas() {
        let list: Vec<&str> =
            parse_list("hips_height, max(1, 2) , foot_l.y").unwrap().into_iter().map(|(text, _)| text.trim()).collect();
        assert_eq!(list, ["hips_height", "max(1, 2)", "foot_l.y"]);
        assert_eq!(parse_list("hips_height,,").unwrap_err().column, 13);
        assert_eq!(parse_list("hips_height,fot_l.y").unwrap_err().column, 13);
    }

    #[test]
    fn what_is_too_large_is_refused() {
        assert!(fault(&"(".repeat(100)).1.contains("too deeply nested"));
        assert!(fault(&"-".repeat(100)).1.contains("too deeply nested"));
        assert!(fault(&vec!["1"; 200].join("+")).1.contains("too long"));
    }

    proptest! {
        #[test]
        fn nothing_panics(text in "[a-z_(),.0-9+*/ \u{fc}-]{0,60}") {
            if let Ok(node) = parse(&text) {
                let _ = (node.value(&frame()), node.unit());
            }
            let _ = parse_list(&text);
        }

        #[test]
        fn anything_at_all_is_heard(text in any::<String>()) {
            let _ = parse(&text);
        }

        #[test]
        fn what_is_made_of_its_words_is_read(words in prop::collection::vec(prop::sample::select(&[
            "hand_l.y", "hips_height", "min(", "sqrt(", "(", ")", "+", "-", "*", "/", ",", "2", " ",
        ][..]), 0..20)) {
            if let Ok(node) = parse(&words.concat()) {
                let _ = node.value(&frame());
            }
        }
    }
}

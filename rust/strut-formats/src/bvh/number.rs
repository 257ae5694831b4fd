//! Exact and fast conversion of decimal text to `f64`.
//!
//! Most numbers of a BVH file have few digits: the significand is an exact integer below 2⁵³ and the power of ten at
//! most 10²², which is also exact, so that one correctly rounded multiplication or division gives the nearest `f64`
//! (Clinger, "How to Read Floating Point Numbers Accurately", 1990). The standard library converts all others.
//!
//! `fast-float2` does the same for all decimals. On the six decimals of usual files it takes 1.5 times as long (133 ns
//! per number against 90 ns, on one noisy machine; 2 million numbers), saves 0.7 kB of gzipped WebAssembly, and accepts
//! "nan" and "inf", which are invalid in a file.

/// Powers of ten that are exact in `f64`.
const EXACT_POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// Parses the number at the start of `text` and returns it with its length in bytes: optional sign, digits with an
/// optional point, optional exponent. `None` if there is no number. The value is the nearest `f64`, infinite if it
/// overflows. The caller checks the text after the number.
// Two fifths of the time to open a file are spent here; a function call for each number would cost a tenth of it.
#[inline(always)]
#[allow(clippy::inline_always)]
pub(super) fn parse_prefix(text: &[u8]) -> Option<(f64, usize)> {
    let mut at = 0;
    let negative = match text.first() {
        Some(b'-') => {
            at = 1;
            true
        }
        Some(b'+') => {
            at = 1;
            false
        }
        _ => false,
    };
    let mut significand = 0_u64;
    let digits_begin = at;
    at = take_digits(text, at, &mut significand);
    let mut digits = at - digits_begin;
    let mut exponent = 0_i64;
    if text.get(at) == Some(&b'.') {
        let fraction_begin = at + 1;
        at = take_digits(text, fraction_begin, &mut significand);
        digits += at - fraction_begin;
        exponent = -((at - fraction_begin) as i64);
    }
    if digits == 0 {
        return None;
    }
    if matches!(text.get(at), Some(b'e' | b'E')) {
        let (value, end) = exponent_at(text, at + 1)?;
        exponent += value;
        at = end;
    }
    // Up to 19 digits cannot have overflowed the significand.
    if digits <= 19 && significand <= 1 << 53 && exponent.unsigned_abs() <= 22 {
        let power = EXACT_POWERS[exponent.unsigned_abs() as usize];
        let magnitude = if exponent < 0 { significand as f64 / power } else { significand as f64 * power };
        return Some((if negative { -magnitude } else { magnitude }, at));
    }
    let value = std::str::from_utf8(&text[..at]).ok()?.parse().ok()?;
    Some((value, at))
}

/// Appends the digits from `at` to the significand (modulo 2⁶⁴). Returns the end of the digits.
fn take_digits(text: &[u8], mut at: usize, significand: &mut u64) -> usize {
    while let Some(digit) = text.get(at).map(|b| b.wrapping_sub(b'0')).filter(|&d| d < 10) {
        *significand = significand.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    at
}

/// Exponent that starts at `at`, saturated, and its end; `None` without a digit.
fn exponent_at(text: &[u8], at: usize) -> Option<(i64, usize)> {
    let (sign, begin) = match text.get(at) {
        Some(b'-') => (-1, at + 1),
        Some(b'+') => (1, at + 1),
        _ => (1, at),
    };
    let mut value = 0_i64;
    let mut end = begin;
    while let Some(digit) = text.get(end).filter(|b| b.is_ascii_digit()) {
        value = (value * 10 + i64::from(digit - b'0')).min(1_000_000);
        end += 1;
    }
    (end > begin).then_some((sign * value, end))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn same_as_std(text: &str) -> Result<(), TestCaseError> {
        let (value, length) = parse_prefix(text.as_bytes()).expect("a number");
        prop_assert_eq!(length, text.len());
        prop_assert_eq!(value.to_bits(), text.parse::<f64>().unwrap().to_bits(), "{}", text);
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn equals_the_standard_library_on_decimals(text in "[-+]?[0-9]{1,24}(\\.[0-9]{0,24})?") {
            same_as_std(&text)?;
        }

        #[test]
        fn equals_the_standard_library_with_exponents(text in "[-+]?[0-9]{0,12}\\.[0-9]{1,9}[eE][-+]?[0-9]{1,3}") {
            same_as_std(&text)?;
        }

        #[test]
        fn reads_back_what_is_printed(value in prop::num::f64::NORMAL | prop::num::f64::SUBNORMAL | prop::num::f64::ZERO) {
            same_as_std(&format!("{value:e}"))?;
            same_as_std(&format!("{value}"))?;
        }
    }

    #[test]
    fn takes_the_longest_prefix_that_is_a_number() {
        assert_eq!(parse_prefix(b"1.5 2"), Some((1.5, 3)));
        assert_eq!(parse_prefix(b".5,"), Some((0.5, 2)));
        assert_eq!(parse_prefix(b"5.x"), Some((5.0, 2)));
        assert_eq!(parse_prefix(b"1e999"), Some((f64::INFINITY, 5)));
        for text in ["", "-", ".", "e5", "nan", "inf", "1e", "1e+", "--1"] {
            assert_eq!(parse_prefix(text.as_bytes()), None, "{text}");
        }
    }
}

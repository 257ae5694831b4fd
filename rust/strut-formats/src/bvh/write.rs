//! Writes [`Bvh`] as text.

use super::{Bvh, encoding};
use std::fmt::Write;

/// Writes the file: [`write_text`] in UTF-8, except for names that were read in another encoding, whose original bytes
/// are written.
pub fn write(bvh: &Bvh) -> Vec<u8> {
    let text = write_text(bvh);
    if bvh.joints.iter().any(|joint| joint.name_bytes.is_some()) {
        encoding::unescaped(&text)
    } else {
        text.into_bytes()
    }
}

/// Writes the file as text, for programs that transfer text: each byte from 0x80 on of a name that is not UTF-8 is a
/// character from U+10FE80 on, in a private-use area. LF line ends, tabs for indentation. Every number has the fewest
/// digits that read back as the same `f64`, so that `parse(write(b)) == b`.
pub fn write_text(bvh: &Bvh) -> String {
    // About ten characters for each value, one line of about 30 for each of five lines per joint.
    let mut out = String::with_capacity(bvh.values.len() * 11 + bvh.joints.len() * 150 + 100);
    out.push_str("HIERARCHY\n");
    write_joints(&mut out, bvh);
    out.push_str("MOTION\nFrames: ");
    push_display(&mut out, bvh.frames);
    out.push_str("\nFrame Time: ");
    push_number(&mut out, bvh.frame_time_secs);
    out.push('\n');
    for row in bvh.values.chunks(bvh.channels().max(1)) {
        for (i, &value) in row.iter().enumerate() {
            if i > 0 {
                out.push(' ');
            }
            push_number(&mut out, value);
        }
        out.push('\n');
    }
    out
}

fn write_joints(out: &mut String, bvh: &Bvh) {
    // Indices of the joints whose braces are open, innermost last.
    let mut open: Vec<usize> = Vec::new();
    for (index, joint) in bvh.joints.iter().enumerate() {
        while open.last().copied() != joint.parent && !open.is_empty() {
            close(out, &mut open);
        }
        let depth = open.len();
        indent(out, depth);
        out.push_str(if joint.parent.is_none() { "ROOT " } else { "JOINT " });
        match &joint.name_bytes {
            Some(bytes) => out.extend(encoding::escaped(bytes)),
            None => out.push_str(&joint.name),
        }
        out.push('\n');
        indent(out, depth);
        out.push_str("{\n");
        push_offset(out, depth + 1, joint.offset);
        indent(out, depth + 1);
        out.push_str("CHANNELS ");
        push_display(out, joint.channels.len());
        for channel in &joint.channels {
            out.push(' ');
            out.push_str(channel.name());
        }
        out.push('\n');
        if let Some(end) = joint.end_site {
            indent(out, depth + 1);
            out.push_str("End Site\n");
            indent(out, depth + 1);
            out.push_str("{\n");
            push_offset(out, depth + 2, end);
            indent(out, depth + 1);
            out.push_str("}\n");
        }
        open.push(index);
    }
    while !open.is_empty() {
        close(out, &mut open);
    }
}

fn close(out: &mut String, open: &mut Vec<usize>) {
    open.pop();
    indent(out, open.len());
    out.push_str("}\n");
}

fn indent(out: &mut String, depth: usize) {
    out.extend(std::iter::repeat_n('\t', depth));
}

fn push_offset(out: &mut String, depth: usize, offset: [f64; 3]) {
    indent(out, depth);
    out.push_str("OFFSET");
    for v in offset {
        out.push(' ');
        push_number(out, v);
    }
    out.push('\n');
}

/// Appends the shortest decimal that reads back as the same number; in scientific notation if that would be mostly zeros.
fn push_number(out: &mut String, value: f64) {
    let written = if value != 0.0 && value.abs() < 1e-5 { write!(out, "{value:e}") } else { write!(out, "{value}") };
    debug_assert!(written.is_ok(), "writing to a string cannot fail");
}

fn push_display(out: &mut String, value: usize) {
    let written = write!(out, "{value}");
    debug_assert!(written.is_ok(), "writing to a string cannot fail");
}

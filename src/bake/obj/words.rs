//! Takes the text of .obj and .mtl files apart.

use std::{borrow::Cow, str::FromStr};

/// Byte order mark in UTF-8, with which some programs begin a text.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Returns a file as text, without a byte order mark; `None` if it is no text. Names may be in any encoding; what
/// matters is ASCII.
pub fn text(bytes: &[u8]) -> Option<Cow<'_, str>> {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    (!bytes.contains(&0)).then(|| String::from_utf8_lossy(bytes))
}

/// Statements of a text, each with the number of its first line, from 1. A backslash at the end of a line continues it.
pub struct Lines<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
}

impl<'a> Lines<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { lines: text.lines().enumerate() }
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, Cow<'a, str>);

    fn next(&mut self) -> Option<Self::Item> {
        let (i, line) = self.lines.next()?;
        let mut statement = Cow::Borrowed(line);
        while statement.ends_with('\\') {
            let whole = statement.to_mut();
            whole.pop();
            whole.push(' ');
            whole.push_str(self.lines.next().map_or("", |(_, next)| next));
        }
        Some((i + 1, statement))
    }
}

/// Reads one number.
pub fn float(word: &str) -> Result<f32, String> {
    f32::from_str(word).map_err(|_| format!("`{word}` is no number"))
}

/// Reads three numbers.
pub fn floats<'a>(words: &mut impl Iterator<Item = &'a str>) -> Result<[f32; 3], String> {
    let mut next = || float(words.next().ok_or("a number is missing")?);
    Ok([next()?, next()?, next()?])
}

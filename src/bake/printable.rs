//! Makes names of a file fit for a line in a terminal.

use std::fmt::{self, Write};

/// Text that is shown with control characters escaped, such as line breaks and the codes that colour a terminal. All
/// other characters are shown as they are.
#[derive(Clone, Copy, Debug)]
pub struct Printable<'a>(pub &'a str);

impl fmt::Display for Printable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            // Marks that turn the direction of writing, or end the line, are no control characters to Unicode.
            let hidden = matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
            if c.is_control() || hidden { write!(f, "{}", c.escape_debug())? } else { f.write_char(c)? }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_nothing_else() {
        let name = "line one\nline two \"quoted\" \u{1b}[31mred \u{1f600} \u{202e}";
        assert_eq!(Printable(name).to_string(), "line one\\nline two \"quoted\" \\u{1b}[31mred \u{1f600} \\u{202e}");
    }
}

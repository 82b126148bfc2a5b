//! Reads and writes ratings of a quantity and a size, such as `flaking 3(S4)`.

use std::fmt;

/// Highest class of quantities and sizes.
pub(super) const MOST: u8 = 5;

/// Returns quantity and size as they are written in `text`, with or without the `name` before them. A size that is not
/// there is 0.
pub(super) fn read(text: &str, name: &str) -> Option<(u8, u8)> {
    let text = text.trim();
    let number = match text.get(..name.len()) {
        Some(begin) if begin.eq_ignore_ascii_case(name) => text.get(name.len()..)?.trim_start(),
        // Without a name it would be any number.
        _ if text.ends_with(')') => text,
        _ => return None,
    };
    let (quantity, size) = match number.split_once('(') {
        Some((quantity, size)) => (quantity, size.strip_suffix(')')?.trim().trim_start_matches(['s', 'S'])),
        None => (number, "0"),
    };
    let class = |text: &str| text.trim().parse().ok().filter(|class| *class <= MOST);
    Some((class(quantity)?, class(size)?))
}

/// Writes quantity and size after the `name`.
pub(super) fn write(f: &mut fmt::Formatter<'_>, name: &str, quantity: u8, size: u8) -> fmt::Result {
    write!(f, "{name} {quantity}")?;
    if size > 0 { write!(f, "(S{size})") } else { Ok(()) }
}

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

/// Gives a rating with the fields `quantity` and `size` what all such ratings have: the classes themselves, and text in
/// which `name` goes before them.
macro_rules! two_classes {
    ($grade:ident, $name:literal) => {
        impl $grade {
            /// Returns a degree of two classes, each 0 (best) to 5 (worst), or `None` for other numbers.
            pub fn new(quantity: u8, size: u8) -> Option<Self> {
                use $crate::survey::ratings::words::MOST;
                (quantity <= MOST && size <= MOST).then_some(Self { quantity, size })
            }

            /// Returns the class of the quantity: 0 (best) to 5 (worst).
            pub fn quantity(self) -> u8 {
                self.quantity
            }

            /// Returns the class of the size: 0 (best) to 5 (worst).
            pub fn size(self) -> u8 {
                self.size
            }
        }

        impl From<$grade> for String {
            fn from(grade: $grade) -> Self {
                grade.to_string()
            }
        }

        impl TryFrom<String> for $grade {
            type Error = $crate::survey::RatingError;

            fn try_from(text: String) -> Result<Self, Self::Error> {
                text.parse()
            }
        }

        impl std::fmt::Display for $grade {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                $crate::survey::ratings::words::write(f, $name, self.quantity, self.size)
            }
        }

        impl std::str::FromStr for $grade {
            type Err = $crate::survey::RatingError;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                let found = $crate::survey::ratings::words::read(text, $name);
                found.map(|(quantity, size)| Self { quantity, size }).ok_or_else(|| $crate::survey::RatingError {
                    found: text.into(),
                    expected: concat!($name, " 0 to ", $name, " 5, or ", $name, " 3(S4)"),
                })
            }
        }
    };
}

pub(super) use two_classes;

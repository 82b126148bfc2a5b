//! Matches names against patterns with wildcards.

/// Pattern of the names of nodes, meshes and materials: `*` stands for any number of characters, `?` for one. All other
/// characters stand for themselves, upper and lower case apart. It holds for whole names.
///
/// ```
/// use bevy_coating::bake::NamePattern;
///
/// let glass = NamePattern::new("*glass_?");
/// assert!(glass.matches("windowglass_1"));
/// assert!(!glass.matches("windowglass_12") && !glass.matches("Glass_1 pane"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamePattern(Box<str>);

impl NamePattern {
    /// Takes the text of a pattern.
    pub fn new(text: &str) -> Self {
        Self(text.into())
    }

    /// Returns the text of the pattern.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Returns whether the whole of `name` is as the pattern says. Takes at most the product of both lengths, whatever
    /// the number of wildcards.
    pub fn matches(&self, name: &str) -> bool {
        let (mut pattern, mut rest) = (self.0.chars(), name.chars());
        // Where to go on if a later character does not fit: past the last `*`, with one more character taken by it.
        let mut again: Option<(std::str::Chars, std::str::Chars)> = None;
        loop {
            let here = rest.clone();
            match (pattern.next(), rest.next()) {
                (Some('*'), _) => {
                    rest = here.clone();
                    again = Some((pattern.clone(), here));
                }
                (Some(wanted), Some(found)) if wanted == '?' || wanted == found => {}
                (None, None) => return true,
                _ => {
                    let Some((after, taken)) = &mut again else { return false };
                    if taken.next().is_none() {
                        return false;
                    }
                    (pattern, rest) = (after.clone(), taken.clone());
                }
            }
        }
    }
}

impl From<&str> for NamePattern {
    fn from(text: &str) -> Self {
        Self::new(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wildcards_stand_for_what_they_say() {
        let cases = [
            ("", "", true),
            ("", "a", false),
            ("*", "", true),
            ("*", "anything at all", true),
            ("?", "", false),
            ("?", "\u{e9}", true),
            ("glass", "glass", true),
            ("glass", "Glass", false),
            ("glass", "glass pane", false),
            ("*glass*", "front glass left", true),
            ("a*b*c", "a b b c", true),
            ("a*b*c", "a b b c d", false),
            ("**a", "ba", true),
            ("*?*?", "a", false),
            ("*ab", "aab", true),
            ("[ab]", "a", false),
        ];
        for (pattern, name, expected) in cases {
            assert_eq!(NamePattern::new(pattern).matches(name), expected, "{pattern:?} {name:?}");
        }
    }

    #[test]
    fn many_wildcards_take_no_longer_than_the_names_are() {
        let pattern = NamePattern::new(&("a*".repeat(200) + "b"));
        assert!(!pattern.matches(&"a".repeat(2_000)));
    }
}

//! Reads the documentation of settings: the unit that it names, and its text without Markdown.

use super::field::Field;

/// Phrases that name a unit, and the unit; the longer of two that begin alike comes first.
const UNITS: [(&str, &str); 17] = [
    ("per unit age and metre", "layer m/age"),
    ("in metres per unit age", "m/age"),
    ("in radians per unit age", "rad/age"),
    ("in radians", "rad"),
    ("per radian", "1/rad"),
    ("per unit age, as a force", "force/age"),
    ("per unit age", "1/age"),
    ("standard deviation in metres", "m"),
    ("in metres", "m"),
    ("in grains", "grain"),
    ("as a force", "force"),
    ("Contraction force", "force"),
    ("Binding force", "force"),
    ("Age for which", "age"),
    ("number of faces", "faces"),
    ("in faces", "faces"),
    ("cycles", "cycles"),
];

impl Field {
    /// Returns the unit of the setting, as its documentation names it in the first sentence; empty for shares, weights
    /// and other plain numbers. "age" is a unit of age, "force" the initial contraction.
    ///
    /// ```
    /// use bevy_coating::settings::CoatingSettings;
    ///
    /// let unit = |path| CoatingSettings::fields().find(|field| field.path == path).map(|field| field.unit());
    /// assert_eq!(unit("rust.speed"), Some("m/age"));
    /// assert_eq!(unit("tearing.relief_reach"), Some("grain"));
    /// assert_eq!(unit("tearing.beta"), Some(""));
    /// ```
    pub fn unit(&self) -> &'static str {
        if !self.names.is_empty() {
            return "";
        }
        let text = self.doc.trim_start();
        let sentence = text.split_once(". ").map_or(text, |(first, _)| first);
        let places = UNITS.iter().filter_map(|&(phrase, unit)| Some((find(sentence, phrase)?, unit)));
        // The first of those at the same place is the longest.
        places.reduce(|best, next| if next.0 < best.0 { next } else { best }).map_or("", |(_, unit)| unit)
    }

    /// Returns the documentation of the setting as plain text: without Markdown's links and marks of code.
    ///
    /// ```
    /// use bevy_coating::settings::CoatingSettings;
    ///
    /// for field in CoatingSettings::fields() {
    ///     let text = field.plain_doc();
    ///     assert!(!text.contains(['`', '[', ']']) && !text.contains("  "), "{text}");
    /// }
    /// ```
    pub fn plain_doc(&self) -> String {
        let mut plain = String::with_capacity(self.doc.len());
        let mut rest = self.doc.trim_start();
        while let Some(at) = rest.find(['`', '[', ']']) {
            let (before, after) = rest.split_at(at);
            plain.push_str(before);
            rest = after.get(1..).unwrap_or_default();
            // The destination of a link.
            if after.starts_with("](")
                && let Some((_, behind)) = rest.split_once(')')
            {
                rest = behind;
            }
        }
        plain.push_str(rest);
        plain
    }
}

/// Returns where `phrase` begins in `text`, at the beginning of a word.
fn find(text: &str, phrase: &str) -> Option<usize> {
    let is_word =
        |&(at, _): &(usize, &str)| !text.get(..at).is_some_and(|before| before.ends_with(char::is_alphanumeric));
    text.match_indices(phrase).find(is_word).map(|(at, _)| at)
}

#[cfg(test)]
mod tests {
    use crate::settings::CoatingSettings;

    #[test]
    fn units_are_those_that_the_documentation_names() {
        let unit = |path: &str| CoatingSettings::fields().find(|field| field.path == path).expect(path).unit();
        for (path, expected) in [
            ("scale.rules", ""),
            ("scale.grain", "m"),
            ("adhesion.mean", "force"),
            ("adhesion.octaves", ""),
            ("adhesion.wavelength", "grain"),
            ("adhesion.decay", "force/age"),
            ("bending.gain", ""),
            ("bending.gamma", "1/rad"),
            ("tearing.contraction_growth", "force/age"),
            ("tearing.contraction_kept", ""),
            ("tearing.binding", "force"),
            ("tearing.binding_decay", "1/age"),
            ("tearing.alpha", ""),
            ("deform.narrowing_rate", "rad/age"),
            ("deform.bend_limit", "rad"),
            ("deform.sweeps_per_age", "1/age"),
            ("stripping.hold", "age"),
            ("stripping.hold_area", "faces"),
            ("rust.emission", "layer m/age"),
            ("rust.speed", "m/age"),
            ("rust.spread", "m"),
            ("dust.rate", "1/age"),
            ("dust.height", ""),
            ("moisture.wash_dust", "m/age"),
        ] {
            let field = CoatingSettings::fields().find(|field| field.path == path).expect(path);
            assert_eq!(unit(path), expected, "{path}: {}", field.doc);
        }
    }
}

//! A number of a run, and the band in which it is to lie.

use std::fmt;

use super::spread::Spread;

/// A number that was measured.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The number, in words.
    pub what: String,
    pub found: Spread,
    /// Least and largest value that the mean may have.
    pub band: [f64; 2],
    /// Digits after the point.
    pub digits: usize,
}

impl Claim {
    pub fn new(what: impl Into<String>, found: Spread, band: [f64; 2], digits: usize) -> Self {
        Self { what: what.into(), found, band, digits }
    }

    /// A number of a single run.
    pub fn single(what: impl Into<String>, found: f64, band: [f64; 2], digits: usize) -> Self {
        Self::new(what, Spread::of(&[found]), band, digits)
    }

    /// Returns whether the mean lies in its band. NaN does not.
    pub fn holds(&self) -> bool {
        (self.band[0]..=self.band[1]).contains(&self.found.mean)
    }

    /// Returns the number as text, with the deviation of seeds if there are several.
    pub fn number(&self) -> String {
        let (mean, digits) = (self.found.mean + 0.0, self.digits);
        match self.found.count {
            0 | 1 => format!("{mean:.digits$}"),
            _ => format!("{mean:.digits$} ± {:.digits$}", self.found.deviation),
        }
    }

    /// Returns the band as text.
    pub fn expected(&self) -> String {
        let ([low, high], digits) = (self.band, self.digits);
        match (low.is_finite(), high.is_finite()) {
            (true, true) if low == high => format!("{low:.digits$}"),
            (true, true) => format!("{low:.digits$} to {high:.digits$}"),
            (true, false) => format!("at least {low:.digits$}"),
            (false, true) => format!("at most {high:.digits$}"),
            (false, false) => "any".to_owned(),
        }
    }
}

impl fmt::Display for Claim {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.holds() { "" } else { "  NOT IN ITS BAND" };
        write!(f, "{}: {} ({}){verdict}", self.what, self.number(), self.expected())
    }
}

//! Sorts lengths and shares into classes.

/// Share of all cracks or bare places from which on a size counts as typical. The standards say "numerous enough to be
/// typical".
const TYPICAL: f64 = 0.1;

/// Returns the class of a value: the number of the rising `limits` that it exceeds.
pub(in crate::survey) fn size_class(value: f64, limits: &[f64]) -> u8 {
    limits.iter().filter(|&&limit| value > limit).count() as u8
}

/// Returns the largest class that is typical: a tenth of all that can be seen is of this class or above. Class 0 cannot
/// be seen.
pub(super) fn typical_class(amounts: &[f64; 6]) -> u8 {
    let all: f64 = amounts[1..].iter().sum();
    let from = |class: &usize| amounts[*class..].iter().sum::<f64>() >= TYPICAL * all;
    if all > 0.0 { (1..amounts.len()).rev().find(from).unwrap_or(1) as u8 } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_begin_above_their_limits() {
        let limits = [0.0, 1.0, 3.0];
        assert_eq!(
            [0.0, 1e-9, 1.0, 1.1, 3.0, 4.0, f64::NAN].map(|value| size_class(value, &limits)),
            [0, 1, 1, 2, 2, 3, 0]
        );
    }

    #[test]
    fn few_large_ones_are_not_typical() {
        assert_eq!(typical_class(&[0.0; 6]), 0);
        assert_eq!(typical_class(&[9.0, 0.0, 0.0, 0.0, 0.0, 0.0]), 0, "nobody sees them");
        assert_eq!(typical_class(&[9.0, 0.0, 95.0, 0.0, 5.0, 0.0]), 2);
        assert_eq!(typical_class(&[9.0, 0.0, 85.0, 0.0, 15.0, 0.0]), 4);
        assert_eq!(typical_class(&[0.0, 82.0, 6.0, 0.0, 6.0, 6.0]), 4, "larger ones count with it");
    }
}

//! Stains that a film begins with.

use super::fields::StainFields;

impl StainFields {
    /// Puts stains on clean paint, one value for each film vertex: `dust` from 0 to 1, `rust` stains in layers, and
    /// `moisture` from 0 to 1. What is out of range is brought into it, what is NaN counts as 0, and what is missing
    /// stays as it is. Where a value is less than the stain that is there, the stain stays.
    ///
    /// The rust counts as given off, so that the budget holds.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, stain::StainFields};
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut stains = StainFields::new(&mesh);
    /// stains.begin_with(&[0.5, 0.0, 0.0], &[0.0, 2.0, 0.0], &[0.0, 0.0, 1.0]);
    /// assert_eq!((stains.film.dust[0], stains.film.stained[1], stains.film.moisture[2]), (0.5, 2.0, 1.0));
    /// assert_eq!(stains.validate(&mesh), Ok(()));
    /// assert!(stains.is_damp());
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn begin_with(&mut self, dust: &[f32], rust: &[f32], moisture: &[f32]) {
        raise(&mut self.film.dust, dust, 1.0);
        raise(&mut self.film.moisture, moisture, 1.0);
        let before = self.stained_amount();
        raise(&mut self.film.stained, rust, f32::MAX);
        self.budget.emitted += self.stained_amount() - before;
        self.damp |= self.film.moisture.iter().any(|&moisture| moisture > 0.0);
        self.revise_if_seen();
    }
}

/// Raises each stain to the value beside it, at most to `most`.
fn raise(stains: &mut [f32], to: &[f32], most: f32) {
    for (stain, &to) in stains.iter_mut().zip(to) {
        if to > *stain {
            *stain = to.min(most);
        }
    }
}

//! Defines touches and what they do.

use thiserror::Error;

use super::site::Site;

/// Greatest radius of a touch, in metres.
pub const MOST_RADIUS: f32 = 10_000.0;
/// Greatest number in a [`Change`] or in an effect. An infinite adhesion or binding may be set too.
pub const MOST_CHANGE: f32 = 1_000.0;

/// Way in which a touch changes a value of the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Change {
    /// The value becomes this one. It no longer follows settings.
    Set(f32),
    /// This is added to the value.
    Add(f32),
    /// The value is multiplied by this, 0 or more. Forces go on following settings.
    Multiply(f32),
}

/// Effect of a touch on the film inside its radius. Its strength falls from the touch's hard core to its rim; what can
/// only happen or not happens where the strength is at least a half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effect {
    /// Changes the adhesion of the film to the metal, a force (VC 3.3): protects, or weakens. An infinite adhesion
    /// never lets go.
    Adhesion(Change),
    /// Changes the binding of edges, a force (VC 3.3): seals, or scores a line that cracks will follow.
    Binding(Change),
    /// Changes the contraction of faces, a force (VC 3.3): more makes them tear and curl earlier.
    Contraction(Change),
    /// Puts wet rust on, in layers: 0 to 1,000. It runs off from there, and stains.
    Rust(f32),
    /// Changes dust on film and open metal, 0 (clean) to 1 (black).
    Dust(Change),
    /// Changes moisture of film and open metal, 0 (dry) to 1 (wet).
    Moisture(Change),
    /// Takes the film off.
    Strip,
    /// Puts new paint on: the film is whole again, lies on the metal, clean, with the forces of fresh paint. The metal
    /// under it is clean, too.
    Repaint,
    /// Strikes with this force at the core, in units of the initial contraction, 0 to 1,000: film lets go and chips
    /// off where the blow is stronger than what holds it, and cracks begin around. By the default settings 0.5 does
    /// nothing to paint of age 0.2, and 5 knocks a hole. It dents nothing.
    Hit(f32),
    /// Cuts the film along a line to another place with a blade; the radius does not matter.
    Scratch(Site),
    /// Washes with this thoroughness, 0 to 1: takes dust and wet rust away and leaves it wet. Half of what rust has
    /// stained stays.
    Wash(f32),
    /// Sands with this thoroughness, 0 to 1: takes dust, stains and the rust of open metal away. Above 0 it also takes
    /// film that no longer lies on the metal.
    Sand(f32),
}

/// Touch of a film: one dab of a brush, or a blow. See [`touch`](super::touch()).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Place of the film that is touched.
    pub site: Site,
    /// Radius along the surface, in metres: above 0 and at most 10,000. A touch smaller than the film's triangles
    /// touches the nearest vertex, and the face that it is in.
    pub radius: f32,
    /// Share of the radius that feels the touch at its full strength: 0 (soft) to 1 (hard). Default 0.5.
    pub hardness: f32,
    /// Effect on the film there.
    pub effect: Effect,
}

impl Touch {
    /// Returns the touch of a brush of medium hardness.
    pub fn new(site: Site, radius: f32, effect: Effect) -> Self {
        Self { site, radius, hardness: 0.5, effect }
    }

    /// Sets the hardness.
    pub fn with_hardness(self, hardness: f32) -> Self {
        Self { hardness, ..self }
    }

    /// Returns the strength of the touch at a `distance` from its place, in metres: 1 at the core, 0 at the rim.
    ///
    /// ```
    /// use bevy_coating::{film::FaceId, touch::{Effect, Site, Touch}};
    /// use bevy_math::Vec3;
    ///
    /// let touch = Touch::new(Site::new(FaceId(0), Vec3::X), 0.2, Effect::Strip);
    /// assert_eq!([0.0, 0.1, 0.2].map(|distance| touch.strength(distance)), [1.0, 1.0, 0.0]);
    /// assert!((touch.strength(0.15) - 0.5).abs() < 1e-6);
    /// ```
    pub fn strength(&self, distance: f32) -> f32 {
        let core = self.radius * self.hardness;
        if distance <= core {
            return 1.0;
        }
        let x = ((self.radius - distance) / (self.radius - core)).clamp(0.0, 1.0);
        // Not a number if the whole brush is core.
        if x > 0.0 { x * x * (3.0 - 2.0 * x) } else { 0.0 }
    }

    /// Checks that all numbers are in range.
    ///
    /// # Errors
    /// [`TouchError`] with the number that is not, and its range.
    pub fn check(&self) -> Result<(), TouchError> {
        let within = |what: &'static str, value: f32, least: f32, most: f32| {
            let fits = (least..=most).contains(&value);
            if fits { Ok(()) } else { Err(TouchError::OutOfRange { what, value, least, most }) }
        };
        within("radius", self.radius, f32::MIN_POSITIVE, MOST_RADIUS)?;
        within("hardness", self.hardness, 0.0, 1.0)?;
        let change = |what: &'static str, change: Change, may_be_infinite: bool, most: f32| match change {
            Change::Set(f32::INFINITY) if may_be_infinite => Ok(()),
            Change::Set(value) => within(what, value, 0.0, most),
            Change::Add(value) => within(what, value, -MOST_CHANGE, MOST_CHANGE),
            Change::Multiply(value) => within(what, value, 0.0, MOST_CHANGE),
        };
        match self.effect {
            Effect::Adhesion(by) => change("adhesion", by, true, MOST_CHANGE),
            Effect::Binding(by) => change("binding", by, true, MOST_CHANGE),
            Effect::Contraction(by) => change("contraction", by, false, MOST_CHANGE),
            Effect::Dust(by) => change("dust", by, false, 1.0),
            Effect::Moisture(by) => change("moisture", by, false, 1.0),
            Effect::Rust(layers) => within("rust", layers, 0.0, MOST_CHANGE),
            Effect::Hit(force) => within("force of the blow", force, 0.0, MOST_CHANGE),
            Effect::Wash(share) | Effect::Sand(share) => within("thoroughness", share, 0.0, 1.0),
            Effect::Strip | Effect::Repaint | Effect::Scratch(_) => Ok(()),
        }
    }
}

/// Error of a touch that cannot be done. The film stays as it was.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum TouchError {
    /// A number is out of its range, or none.
    #[error("the {what} of a touch is {value}, but must be from {least} to {most}")]
    OutOfRange {
        /// Name of the number.
        what: &'static str,
        /// Number that was found.
        value: f32,
        /// Least number that is allowed.
        least: f32,
        /// Greatest number that is allowed.
        most: f32,
    },
    /// The film has no such face.
    #[error("a touch is in face {face}, but the film has {faces} faces: look the place up on this film")]
    NoFace {
        /// Number of the face.
        face: u32,
        /// Number of faces of the film.
        faces: usize,
    },
}

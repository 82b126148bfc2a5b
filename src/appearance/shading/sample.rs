//! Defines [`StainSample`], the stains at one place of a surface.

use bevy_math::Vec3;

/// Stains at one place of a surface, and where that place lies at rest.
///
/// Samples are interpolated from [`MeshPart::stains`](super::super::MeshPart::stains),
/// [`MeshPart::rest`](super::super::MeshPart::rest) and
/// [`MeshPart::rest_normals`](super::super::MeshPart::rest_normals). The default is a clean place at the origin whose
/// normal is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StainSample {
    /// Thickness of rust that has run off onto this place, in layers: 0 or more, where 1 is a full coat.
    pub rust: f32,
    /// Amount of dust: 0 (clean) to 1 (black).
    pub dust: f32,
    /// Amount of moisture: 0 (dry) to 1 (wet).
    pub moisture: f32,
    /// Corrosion of the metal at or under this place: 0 (bright) to 1 (rusted through).
    pub corrosion: f32,
    /// Position of the place at rest, in metres in the film's space.
    pub rest: Vec3,
    /// Normal of the surface at rest: of unit length, or zero if it is not known.
    pub normal: Vec3,
}

impl StainSample {
    /// Returns the sample of one vertex from its entries of [`MeshPart::stains`](super::super::MeshPart::stains)
    /// (layers of rust, dust, moisture, corrosion), `rest` and `rest_normals`.
    ///
    /// ```
    /// use bevy_coating::appearance::shading::StainSample;
    /// use bevy_math::Vec3;
    ///
    /// let sample = StainSample::new([0.4, 0.1, 0.0, 0.0], Vec3::ZERO, Vec3::Z);
    /// assert_eq!((sample.rust, sample.dust), (0.4, 0.1));
    /// ```
    pub fn new([rust, dust, moisture, corrosion]: [f32; 4], rest: Vec3, normal: Vec3) -> Self {
        Self { rust, dust, moisture, corrosion, rest, normal }
    }
}

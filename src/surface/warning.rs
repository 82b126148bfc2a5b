//! Warnings of building a film.

/// Repair that was made, or wish that could not be met, while a film was built. Its text says how often.
///
/// ```
/// use bevy_coating::surface::{BuildWarning, Surface, clean};
/// use bevy_math::Vec3;
///
/// // The second triangle repeats the first.
/// let surface = Surface {
///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
///     triangles: vec![[0, 1, 2], [0, 1, 2]],
///     ..Surface::default()
/// };
/// let clean = clean(&surface)?;
/// assert_eq!(clean.warnings, [BuildWarning::DuplicatesDropped(1)]);
/// assert_eq!(clean.warnings[0].to_string(), "1 repeated triangles were dropped");
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildWarning {
    /// Triangles without area were dropped. Holds their number.
    #[error("{0} triangles without area were dropped")]
    DegenerateDropped(u32),
    /// Triangles that repeat another one were dropped. Holds their number.
    #[error("{0} repeated triangles were dropped")]
    DuplicatesDropped(u32),
    /// Edges with more than two faces were split, so that no more than two faces share an edge. Holds their number.
    #[error("{0} edges with more than two faces were split")]
    NonManifoldEdgesSplit(u32),
    /// Vertices at which several sheets met in a point were split, one vertex for each sheet. Holds their number.
    #[error("{0} vertices where sheets met in a point were split")]
    NonManifoldVerticesSplit(u32),
    /// Edges of one-sided shells (such as Moebius bands) were cut where the two sides meet. Holds their number.
    #[error("{0} edges of one-sided shells were cut where the two sides meet")]
    OneSidedEdgesCut(u32),
    /// Triangles were turned over, to face to the same side as their shell. Holds their number.
    #[error("{0} triangles were turned over to face like their shell")]
    WindingTurned(u32),
    /// The film has more triangles than were asked for, since its creases and seams are too close together for fewer.
    #[error("its creases and seams are finer than {target} triangles can follow: {triangles} were used")]
    FeaturesDenserThanTarget {
        /// Number of triangles that was asked for.
        target: u32,
        /// Number of triangles that the film has.
        triangles: u32,
    },
    /// Corners, facets or creases that are closer together than the film's vertices were passed over, since the film
    /// would have had far more triangles than were asked for, or needles.
    #[error(
        "corners, facets or creases closer together than the vertices of the film were passed over, since {target} \
         triangles are too few to follow them: ask for more, or keep the triangles of the mesh"
    )]
    FeaturesSimplified {
        /// Number of triangles that was asked for.
        target: u32,
    },
    /// Small separate parts lost their shape, since there are too many of them for the film's triangles.
    #[error("{parts} small separate parts lost their shape: ask for at least {triangles} triangles to keep it")]
    SmallPartsCoarse {
        /// Number of the parts.
        parts: u32,
        /// Number of triangles that would show their shape.
        triangles: u32,
    },
    /// The film is noticeably smaller than the prop, since its triangles cut corners on round places.
    #[error(
        "the film of {target} triangles is coarse for this shape: its area changed by {area:.1} %{}; ask for \
         {triangles} triangles or more",
        volume.map(|volume| format!(" and the volume inside by {volume:.1} %")).unwrap_or_default()
    )]
    ShapeCoarse {
        /// Number of triangles that was asked for.
        target: u32,
        /// Change of the area, in percent.
        area: f32,
        /// Change of the enclosed volume, in percent, if the surface is closed.
        volume: Option<f32>,
        /// Number of triangles that would follow the shape closely.
        triangles: u32,
    },
    /// The film's edges are too long for the grain by which its cracks and curls are measured
    /// ([`Rules::Grain`](crate::settings::Rules::Grain)).
    #[error(
        "its edges are {} m long in the mean, which is coarse for a grain of {asked} m{}; {triangles} triangles would \
         do: ask for as many (or raise `max_triangles` to that), or for a larger `scale.grain`",
        rounded(*edge),
        if grain > asked { format!(", so it has a grain of {} m", rounded(*grain)) } else { String::new() }
    )]
    CoarserThanGrain {
        /// Grain that the settings ask for, in metres.
        asked: f32,
        /// Mean edge of the film, in metres.
        edge: f32,
        /// Grain that the film has, in metres: the one asked for, or half the mean edge if that is larger.
        grain: f32,
        /// Number of triangles that would do: of all films of the coating together where they share a number, else of
        /// this film.
        triangles: u32,
    },
}

/// Returns a length to three digits.
fn rounded(length: f32) -> f32 {
    format!("{length:.2e}").parse().unwrap_or(length)
}

//! What the user of a film should know about the surface it was made of.

/// Something that was put right, or could not be met, while a film was built. Its text says what, and how often.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildWarning {
    /// Triangles without area were dropped.
    #[error("{0} triangles without area were dropped")]
    DegenerateDropped(u32),
    /// Triangles that repeat another one were dropped.
    #[error("{0} repeated triangles were dropped")]
    DuplicatesDropped(u32),
    /// Edges with more than two faces were split into manifold sheets.
    #[error("{0} edges with more than two faces were split")]
    NonManifoldEdgesSplit(u32),
    /// Vertices where sheets met in a point were split.
    #[error("{0} vertices where sheets met in a point were split")]
    NonManifoldVerticesSplit(u32),
    /// Edges of one-sided shells (Möbius bands) that were cut where the two sides meet.
    #[error("{0} edges of one-sided shells were cut where the two sides meet")]
    OneSidedEdgesCut(u32),
    /// Triangles whose winding was turned to agree with their shell.
    #[error("{0} triangles were turned over to face like their shell")]
    WindingTurned(u32),
    /// Feature lines are denser than the target edge: the film is finer there.
    #[error("its creases and seams are finer than {target} triangles can follow: {triangles} were used")]
    FeaturesDenserThanTarget {
        /// Triangles asked for.
        target: u32,
        /// Triangles there are.
        triangles: u32,
    },
}

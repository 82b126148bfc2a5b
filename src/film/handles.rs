//! Typed handles of the film mesh. Each is a `u32` index that stays valid for the life of the film:
//! tearing appends vertices and stripping switches faces off, but nothing is ever renumbered.

macro_rules! handle {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The handle of nothing, as stored in flat arrays.
            pub const NONE: Self = Self(u32::MAX);

            /// The handle of the element at `index`. Films are far below 2^32 elements: the builder
            /// refuses larger ones.
            #[inline]
            pub fn new(index: usize) -> Self {
                debug_assert!(index < u32::MAX as usize);
                Self(index as u32)
            }

            /// The position of the element in the flat arrays.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// `None` for [`Self::NONE`].
            #[inline]
            pub fn get(self) -> Option<Self> {
                (self != Self::NONE).then_some(self)
            }
        }
    };
}

handle!(
    /// A vertex of the film.
    VertexId
);
handle!(
    /// A triangle of the film.
    FaceId
);
handle!(
    /// A directed edge of a face. Face `f` owns half-edges `3f`, `3f + 1` and `3f + 2`; half-edge `3f + i`
    /// runs from the face's corner `i` to its corner `i + 1`.
    HalfEdgeId
);

impl FaceId {
    /// The three half-edges of the face, counter-clockwise seen from outside.
    #[inline]
    pub fn half_edges(self) -> [HalfEdgeId; 3] {
        let h = self.0 * 3;
        [HalfEdgeId(h), HalfEdgeId(h + 1), HalfEdgeId(h + 2)]
    }
}

impl HalfEdgeId {
    /// The face that owns the half-edge.
    #[inline]
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// The next half-edge of the same face.
    #[inline]
    pub fn next(self) -> Self {
        Self(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// The previous half-edge of the same face.
    #[inline]
    pub fn previous(self) -> Self {
        Self(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }
}

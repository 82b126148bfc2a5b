//! Typed handles of the film's elements. Each is an index that stays valid for the life of the film, since nothing is
//! ever renumbered.

macro_rules! handle {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// Handle of no element, for flat arrays in which an entry may be missing.
            pub const NONE: Self = Self(u32::MAX);

            /// Returns the handle of the element at `index`, which must be below `u32::MAX`. Built films are always
            /// far below.
            #[inline]
            pub fn new(index: usize) -> Self {
                debug_assert!(index < u32::MAX as usize);
                Self(index as u32)
            }

            /// Returns the index of the element in flat arrays.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// Returns the handle itself, or `None` if it is [`Self::NONE`].
            #[inline]
            pub fn get(self) -> Option<Self> {
                (self != Self::NONE).then_some(self)
            }
        }
    };
}

handle!(
    /// Handle of a vertex of the film. It holds the index of the vertex.
    VertexId
);
handle!(
    /// Handle of a face (a triangle) of the film. It holds the index of the face.
    FaceId
);
handle!(
    /// Handle of a half-edge: an edge of a face with a direction, counter-clockwise around the face seen from outside.
    ///
    /// Face `f` owns half-edges `3 * f`, `3 * f + 1` and `3 * f + 2`. Half-edge `3 * f + i` runs from corner `i` of the
    /// face to the next corner.
    ///
    /// ```
    /// use bevy_coating::film::{FaceId, HalfEdgeId};
    ///
    /// let [a, b, c] = FaceId(4).half_edges();
    /// assert_eq!([a, b, c], [HalfEdgeId(12), HalfEdgeId(13), HalfEdgeId(14)]);
    /// assert_eq!((a.next(), c.next(), a.previous()), (b, a, c));
    /// assert_eq!(b.face(), FaceId(4));
    /// assert_eq!(HalfEdgeId::NONE.get(), None);
    /// ```
    HalfEdgeId
);

impl FaceId {
    /// Returns the three half-edges of the face, counter-clockwise seen from outside.
    #[inline]
    pub fn half_edges(self) -> [HalfEdgeId; 3] {
        let h = self.0 * 3;
        [HalfEdgeId(h), HalfEdgeId(h + 1), HalfEdgeId(h + 2)]
    }
}

impl HalfEdgeId {
    /// Returns the face that owns the half-edge.
    #[inline]
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// Returns the next half-edge of the same face, counter-clockwise.
    #[inline]
    pub fn next(self) -> Self {
        Self(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// Returns the previous half-edge of the same face, counter-clockwise.
    #[inline]
    pub fn previous(self) -> Self {
        Self(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }
}

//! Defines [`Site`], a place on a film.

use bevy_math::Vec3;

use crate::film::{FaceId, FilmMesh};

/// Steps of a coordinate of a site from one corner of its face to the opposite edge.
const STEPS: f32 = 65_535.0;

/// Place on a film, in one of its faces, whether that is still there or not. It stays with the face wherever the face
/// moves.
///
/// Coordinates in the face are kept in steps of 1/65,535, so that a place can be sent and replayed to the bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Site {
    /// Face of the film.
    pub face: FaceId,
    /// Shares of the first and of the second corner in the place, in steps of 1/65,535. That of the third is what is
    /// left.
    pub shares: [u16; 2],
}

impl Site {
    /// Returns the place in `face` with these barycentric coordinates: the shares of its three corners. Shares outside
    /// the face are moved into it, and without any that is above 0 it is the middle.
    ///
    /// ```
    /// use bevy_coating::{film::FaceId, touch::Site};
    /// use bevy_math::Vec3;
    ///
    /// assert_eq!(Site::new(FaceId(7), Vec3::X).barycentric(), Vec3::X);
    /// let middle = Site::new(FaceId(7), Vec3::splat(f32::NAN)).barycentric();
    /// assert!(middle.distance(Vec3::splat(1.0 / 3.0)) < 1e-4);
    /// ```
    pub fn new(face: FaceId, barycentric: Vec3) -> Self {
        let shares = barycentric.to_array().map(|share| if share > 0.0 { share.min(f32::MAX / 4.0) } else { 0.0 });
        let sum: f32 = shares.iter().sum();
        let [a, b, _] = if sum > 0.0 { shares.map(|share| share / sum) } else { [1.0 / 3.0; 3] };
        let a = (a * STEPS + 0.5) as u16;
        let b = (b * STEPS + 0.5) as u16;
        Self { face, shares: [a, b.min(u16::MAX - a)] }
    }

    /// Returns the shares of the three corners of the face, which add up to 1.
    pub fn barycentric(self) -> Vec3 {
        let [a, b] = self.shares;
        let c = u16::MAX.saturating_sub(a).saturating_sub(b);
        Vec3::new(f32::from(a), f32::from(b), f32::from(c)) / STEPS
    }

    /// Returns where the place is at rest, in the film's space. `None` if the film has no such face.
    pub fn at_rest(self, mesh: &FilmMesh) -> Option<Vec3> {
        let corners = self.corners(mesh)?.map(|v| mesh.geometry.rest_positions[v]);
        Some(self.mix(corners))
    }

    /// Returns where the place is now, in the film's space: on the metal if the face is gone. `None` if the film has no
    /// such face.
    pub fn position(self, mesh: &FilmMesh) -> Option<Vec3> {
        if self.face.index() < mesh.topology.face_count() && mesh.topology.is_live(self.face) {
            let corners = mesh.topology.corners(self.face).map(|v| mesh.geometry.positions[v.index()]);
            Some(self.mix(corners))
        } else {
            self.at_rest(mesh)
        }
    }

    fn corners(self, mesh: &FilmMesh) -> Option<[usize; 3]> {
        let topology = &mesh.topology;
        let is_there = self.face.index() < topology.face_count();
        is_there.then(|| topology.corners(self.face).map(|v| topology.original(v).index()))
    }

    fn mix(self, [a, b, c]: [Vec3; 3]) -> Vec3 {
        let shares = self.barycentric();
        a * shares.x + b * shares.y + c * shares.z
    }
}

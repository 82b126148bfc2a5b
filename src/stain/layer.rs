//! Holds the stains of one surface: the film, or the metal under it.

/// Stains of one surface. Every field has one entry for each vertex: of the film, duplicates included, or of the metal,
/// which has only the original vertices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StainLayer {
    /// Wet rust, which runs off, at each vertex: 0 or more, in layers. One layer is a full coat of rust.
    pub wet: Vec<f32>,
    /// Rust that has dried on and stained the surface for good, at each vertex: 0 or more, in layers.
    pub stained: Vec<f32>,
    /// Dust and soot at each vertex (VC 6.2): from 0 (clean) to 1 (black).
    pub dust: Vec<f32>,
    /// Moisture at each vertex: from 0 (dry) to 1 (wet).
    pub moisture: Vec<f32>,
    /// Area at rest that each vertex stands for: a third of each of its faces, in square metres. It is 0 once the
    /// vertex has no faces.
    pub areas: Vec<f32>,
}

impl StainLayer {
    /// Creates a clean, dry layer.
    pub(super) fn new(areas: Vec<f32>) -> Self {
        let clean = vec![0.0; areas.len()];
        Self { wet: clean.clone(), stained: clean.clone(), dust: clean.clone(), moisture: clean, areas }
    }

    /// Returns the rust at vertex `i`, wet and stained together, in layers. Panics if there is no such vertex.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, stain::StainFields};
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut stains = StainFields::new(&mesh);
    /// (stains.film.wet[1], stains.film.stained[1]) = (0.25, 0.5);
    /// assert_eq!(stains.film.rust(1), 0.75);
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn rust(&self, i: usize) -> f32 {
        self.wet[i] + self.stained[i]
    }

    /// Cleans and dries vertex `i`. Returns the rust that it had, in layers times square metres.
    pub(super) fn clean(&mut self, i: usize) -> f64 {
        let rust = f64::from(self.areas[i]) * (f64::from(self.wet[i]) + f64::from(self.stained[i]));
        (self.wet[i], self.stained[i], self.dust[i], self.moisture[i]) = (0.0, 0.0, 0.0, 0.0);
        rust
    }

    /// Appends a vertex with the stains of vertex `i` and without an area.
    pub(super) fn duplicate(&mut self, i: usize) {
        self.wet.push(self.wet[i]);
        self.stained.push(self.stained[i]);
        self.dust.push(self.dust[i]);
        self.moisture.push(self.moisture[i]);
        self.areas.push(0.0);
    }
}

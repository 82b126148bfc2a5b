//! What can be measured on a film: fracture statistics, strain and lift.

use serde::{Deserialize, Serialize};

use super::FilmState;
use crate::{
    film::{FaceFate, HalfEdgeId, LoosePieces, PieceScratch, VertexId},
    stain::{RustBudget, RustSource},
};

/// Figures of a film at one age. Shares are of the film at rest; `None` where there is nothing to average.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FilmMeasures {
    /// Age of the film.
    pub age: f64,
    /// Original vertices ever separated, over original vertices.
    pub separated: Option<f64>,
    /// Torn edges over edges with two faces at rest.
    pub torn: Option<f64>,
    /// Faces removed with all edges torn, over original faces; cumulative.
    pub stripped: Option<f64>,
    /// Faces that fell as loose pieces, over original faces; cumulative.
    pub fallen: Option<f64>,
    /// Live vertices, duplicates included.
    pub vertices: u64,
    /// Live crack tips.
    pub crack_tips: u64,
    /// Original inner vertices with three or more torn edges.
    pub junctions: u64,
    /// Mean cosine of the crack's turn over original inner vertices with exactly two torn edges, at rest:
    /// +1 is straight on.
    pub straightness: Option<f64>,
    /// Sum of rest lengths of torn edges, each once, over the square root of the rest area.
    pub crack_length: Option<f64>,
    /// Pieces of live faces joined across bound edges.
    pub pieces: u64,
    /// Those without an attached vertex.
    pub loose_pieces: u64,
    /// Root mean square of |l - l0| / l0 over active length constraints.
    pub strain_rms: Option<f64>,
    /// Largest of the same.
    pub strain_max: Option<f64>,
    /// 90th percentile (nearest rank), over live separated vertices, of the height over their plane in mean
    /// rest edges.
    pub lift_p90: Option<f64>,
    /// Rust that sources have given off so far: layers times square metres. It is all of what is wet, what has
    /// stained and what has dripped, on film and metal.
    pub rust_emitted: f64,
    /// Rust that runs off now.
    pub rust_wet: f64,
    /// Rust that has stained film and metal for good.
    pub rust_stained: f64,
    /// Rust that left: dripped off, or fell with the pieces that it was on.
    pub rust_dripped: f64,
    /// Film vertices that rust comes out of.
    pub sources: u64,
    /// Mean dust over live film vertices: 0 clean to 1 black.
    pub dust_mean: Option<f64>,
    /// Mean moisture over live film vertices: 0 dry to 1 wet.
    pub moisture_mean: Option<f64>,
}

impl FilmState {
    /// Measures the film as it is now.
    pub fn measure(&self) -> FilmMeasures {
        Self::measure_all(std::slice::from_ref(self))
    }

    /// Measures several films as one: counts are added up, shares and means taken over all of them. The age
    /// is the first film's. Crack length is over the square root of the whole rest area, lift in each film's
    /// own mean edge.
    pub fn measure_all(films: &[Self]) -> FilmMeasures {
        let mut sums = Sums::default();
        for film in films {
            sums.add(film);
        }
        sums.finish(films.first().map_or(0.0, |film| film.clock.age()))
    }
}

/// Sums over films, before they become shares and means.
#[derive(Default)]
struct Sums {
    original_vertices: u64,
    separated: u64,
    inner_edges: u64,
    torn: u64,
    faces: u64,
    stripped: u64,
    fallen: u64,
    vertices: u64,
    tips: u64,
    junctions: u64,
    straight: Vec<f64>,
    crack_length: f64,
    area: f64,
    pieces: u64,
    loose: u64,
    strain_squares: f64,
    strain_max: f64,
    strains: u64,
    heights: Vec<f32>,
    budget: RustBudget,
    wet: f64,
    stained: f64,
    sources: u64,
    dust: f64,
    moisture: f64,
}

impl Sums {
    fn add(&mut self, film: &FilmState) {
        self.add_fracture(film);
        self.add_crack_shapes(film);
        self.add_deformation(film);
        self.add_stains(film);
    }

    fn add_fracture(&mut self, film: &FilmState) {
        let topology = &film.mesh.topology;
        let originals = topology.original_vertex_count();
        self.original_vertices += originals as u64;
        self.separated += (0..originals).filter(|&v| !film.forces.is_attached(VertexId::new(v))).count() as u64;
        self.faces += topology.face_count() as u64;
        for f in topology.all_faces() {
            match topology.fate(f) {
                FaceFate::Live => {}
                FaceFate::Stripped => self.stripped += 1,
                FaceFate::Fallen => self.fallen += 1,
            }
        }
        for h in topology.all_edges().filter(|&h| topology.rest_twin(h).is_some()) {
            self.inner_edges += 1;
            if topology.is_torn(h) {
                self.torn += 1;
                self.crack_length += f64::from(film.mesh.geometry.rest_lengths[h.index()]);
            }
        }
        self.area += f64::from(film.mesh.geometry.rest_area);
        let live = topology.all_vertices().filter(|&v| topology.has_faces(v));
        for v in live {
            self.vertices += 1;
            self.tips += u64::from(film.forces.tip(v).is_some());
        }
        let mut loose = LoosePieces::default();
        let is_attached = |v| film.forces.is_attached(v);
        self.pieces += loose.find(topology, &mut PieceScratch::default(), is_attached) as u64;
        self.loose += loose.len() as u64;
    }

    /// Turns and junctions of cracks at the original inner vertices, at rest.
    fn add_crack_shapes(&mut self, film: &FilmState) {
        let topology = &film.mesh.topology;
        let original = |v: VertexId| topology.original(v);
        // For each original vertex: torn edges, and the other ends of the first two.
        let mut torn = vec![(0u32, [VertexId::NONE; 2]); topology.original_vertex_count()];
        let mut border = vec![false; topology.original_vertex_count()];
        for h in topology.all_edges() {
            let ends = edge_ends(film, h);
            if topology.rest_twin(h).is_none() {
                for v in ends {
                    border[v.index()] = true;
                }
            } else if topology.is_torn(h) {
                for (v, other) in [(ends[0], ends[1]), (ends[1], ends[0])] {
                    let (count, others) = &mut torn[v.index()];
                    if let Some(slot) = others.get_mut(*count as usize) {
                        *slot = other;
                    }
                    *count += 1;
                }
            }
        }
        let rest = |v: VertexId| film.mesh.geometry.rest_positions[original(v).index()];
        for (i, &(count, [a, b])) in torn.iter().enumerate() {
            let v = VertexId::new(i);
            if border[i] {
                continue;
            }
            if count >= 3 {
                self.junctions += 1;
            } else if count == 2 {
                let (along, on) = ((rest(v) - rest(a)).normalize_or_zero(), (rest(b) - rest(v)).normalize_or_zero());
                self.straight.push(f64::from(along.dot(on)));
            }
        }
    }

    fn add_deformation(&mut self, film: &FilmState) {
        let geometry = &film.mesh.geometry;
        for c in film.constraints.lengths(&film.mesh) {
            let [a, b] = c.ends.map(|v| geometry.positions[v as usize]);
            let strain = f64::from((a.distance(b) - c.rest).abs() / c.rest);
            self.strain_squares += strain * strain;
            self.strain_max = self.strain_max.max(strain);
            self.strains += 1;
        }
        let topology = &film.mesh.topology;
        let lifted = topology.all_vertices().filter(|&v| topology.has_faces(v) && !film.forces.is_attached(v));
        self.heights.extend(lifted.map(|v| geometry.height(v) / geometry.mean_edge));
    }

    fn add_stains(&mut self, film: &FilmState) {
        let stains = &film.stains;
        self.budget.emitted += stains.budget.emitted;
        self.budget.dripped += stains.budget.dripped;
        self.wet += stains.wet_amount();
        self.stained += stains.stained_amount();
        self.sources += stains.sources.iter().filter(|&&source| source == RustSource::Present).count() as u64;
        for v in film.mesh.topology.all_vertices().filter(|&v| film.mesh.topology.has_faces(v)) {
            self.dust += f64::from(stains.film.dust[v.index()]);
            self.moisture += f64::from(stains.film.moisture[v.index()]);
        }
    }

    fn finish(mut self, age: f64) -> FilmMeasures {
        let share = |part: u64, whole: u64| (whole > 0).then(|| part as f64 / whole as f64);
        self.heights.sort_unstable_by(f32::total_cmp);
        let rank = (self.heights.len() * 9).div_ceil(10);
        FilmMeasures {
            age,
            separated: share(self.separated, self.original_vertices),
            torn: share(self.torn, self.inner_edges),
            stripped: share(self.stripped, self.faces),
            fallen: share(self.fallen, self.faces),
            vertices: self.vertices,
            crack_tips: self.tips,
            junctions: self.junctions,
            straightness: (!self.straight.is_empty())
                .then(|| self.straight.iter().sum::<f64>() / self.straight.len() as f64),
            crack_length: (self.area > 0.0).then(|| self.crack_length / self.area.sqrt()),
            pieces: self.pieces,
            loose_pieces: self.loose,
            strain_rms: (self.strains > 0).then(|| (self.strain_squares / self.strains as f64).sqrt()),
            strain_max: (self.strains > 0).then_some(self.strain_max),
            lift_p90: rank.checked_sub(1).and_then(|i| self.heights.get(i)).map(|&h| f64::from(h)),
            rust_emitted: self.budget.emitted,
            rust_wet: self.wet,
            rust_stained: self.stained,
            rust_dripped: self.budget.dripped,
            sources: self.sources,
            dust_mean: (self.vertices > 0).then(|| self.dust / self.vertices as f64),
            moisture_mean: (self.vertices > 0).then(|| self.moisture / self.vertices as f64),
        }
    }
}

/// The original vertices at the ends of the edge of `h`.
fn edge_ends(film: &FilmState, h: HalfEdgeId) -> [VertexId; 2] {
    let topology = &film.mesh.topology;
    [topology.origin(h), topology.target(h)].map(|v| topology.original(v))
}

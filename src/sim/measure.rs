//! Measures films: fracture statistics, strain, lift and stains.

use std::f64::consts::FRAC_PI_2;

use super::{film_measures::FilmMeasures, state::FilmState};
use crate::{
    film::{FaceFate, HalfEdgeId, LoosePieces, PieceScratch, VertexId},
    stain::{RustBudget, RustSource},
};

impl FilmState {
    /// Measures the film as it is now.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState};
    ///
    /// let piece = sample::plate(100, 7)?;
    /// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// let fresh = film.measure();
    /// assert_eq!((fresh.separated, fresh.torn, fresh.pieces), (Some(0.0), Some(0.0), 1));
    /// assert_eq!(fresh.lift_p90, None, "no vertex has separated");
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn measure(&self) -> FilmMeasures {
        Self::measure_all(std::slice::from_ref(self))
    }

    /// Measures several films together: counts and amounts are added up, shares and means are taken over all films.
    ///
    /// The age is that of the first film, or 0 if there is none. Crack length is relative to the square root of the
    /// total rest area; the lift in edges of each film is in its own mean edge.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState};
    ///
    /// let settings = CoatingSettings::default();
    /// let piece = sample::plate(100, 7)?;
    /// let film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
    /// let both = FilmState::measure_all(&[film.clone(), film.clone()]);
    /// assert_eq!(both.vertices, 2 * film.measure().vertices);
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn measure_all(films: &[Self]) -> FilmMeasures {
        let mut sums = Sums::default();
        for film in films {
            sums.add(film);
        }
        sums.finish(films.first().map_or(0.0, |film| film.clock.age()))
    }
}

/// Sums over films, from which shares and means are computed in the end.
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
    /// Height and area of each separated vertex that has faces.
    lifts: Vec<(f32, f32)>,
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

    /// Adds the turns and junctions of cracks at the original inner vertices, at rest.
    fn add_crack_shapes(&mut self, film: &FilmState) {
        let topology = &film.mesh.topology;
        let original = |v: VertexId| topology.original(v);
        // For each original vertex the number of torn edges, and the other ends of the first two.
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
        for v in lifted {
            let height = geometry.height(v);
            self.heights.push(height / geometry.mean_edge);
            let area = film.stains.film.areas.get(v.index()).copied().unwrap_or_default();
            self.lifts.push((height, area));
        }
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
        let [lift_area_p50_m, lift_area_p90_m, lift_area_p99_m] = percentiles_by_area(self.lifts, [0.5, 0.9, 0.99]);
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
            // A line of length s on the surface meets 2 s / pi times the cracks' length per area.
            crack_spacing: (self.area > 0.0 && self.crack_length > 0.0)
                .then(|| self.area * FRAC_PI_2 / self.crack_length),
            pieces: self.pieces,
            loose_pieces: self.loose,
            strain_rms: (self.strains > 0).then(|| (self.strain_squares / self.strains as f64).sqrt()),
            strain_max: (self.strains > 0).then_some(self.strain_max),
            lift_p90: rank.checked_sub(1).and_then(|i| self.heights.get(i)).map(|&h| f64::from(h)),
            lift_area_p50_m,
            lift_area_p90_m,
            lift_area_p99_m,
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

/// Returns, for each of the rising `shares`, the least height up to which so much of the area lies. `lifts` are heights
/// and areas.
fn percentiles_by_area<const N: usize>(mut lifts: Vec<(f32, f32)>, shares: [f64; N]) -> [Option<f64>; N] {
    lifts.retain(|&(_, area)| area > 0.0);
    lifts.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let all: f64 = lifts.iter().map(|&(_, area)| f64::from(area)).sum();
    let (mut below, mut rest) = (0.0, lifts.iter());
    let mut height = None;
    shares.map(|share| {
        while below < share * all
            && let Some(&(next, area)) = rest.next()
        {
            below += f64::from(area);
            height = Some(f64::from(next));
        }
        height
    })
}

/// Returns the original vertices at the ends of the edge of `h`.
fn edge_ends(film: &FilmState, h: HalfEdgeId) -> [VertexId; 2] {
    let topology = &film.mesh.topology;
    [topology.origin(h), topology.target(h)].map(|v| topology.original(v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_count_area_and_not_vertices() {
        let of = |lifts: &[(f32, f32)]| percentiles_by_area(lifts.to_vec(), [0.5, 0.9, 0.99]);
        assert_eq!(of(&[]), [None; 3]);
        assert_eq!(of(&[(1.0, 0.0), (f32::NAN, f32::NAN)]), [None; 3], "nothing that has an area");
        assert_eq!(of(&[(2.0, 0.25)]), [Some(2.0); 3]);
        // Nine narrow places that stand up, and a wide one that lies flat.
        let mut lifts = vec![(3.0, 0.0625); 9];
        lifts.push((0.5, 8.0));
        assert_eq!(of(&lifts), [Some(0.5), Some(0.5), Some(3.0)]);
        let even: Vec<(f32, f32)> = (1..=100).rev().map(|i| (i as f32, 0.5)).collect();
        assert_eq!(of(&even), [Some(50.0), Some(90.0), Some(99.0)]);
    }
}

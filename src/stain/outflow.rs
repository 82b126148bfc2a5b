//! Computes where run-off goes from one vertex: along gravity and wind projected on the surface (VC 6.1, fig. 10).
//!
//! The paper shares run-off among all lower neighbours, so that it fans out over a third of the ring at every edge.
//! Here it goes to the two neighbours on either side of its direction, shared so that it keeps that direction on
//! average: streaks stay narrow and straight on any film. Dividing it between two edges spreads run-off sideways by
//! itself; if that is less than the spread asked for, the direction is turned to both sides.

use bevy_math::Vec3;

use super::{duplicates::Duplicates, slope::LEAST_PULL};
use crate::film::{FilmMesh, VertexId};

/// Largest number of targets of run-off from one vertex.
const WAYS: usize = 5;
/// Largest tangent of the angle by which the direction of run-off is turned to spread it.
const WIDEST_TURN: f32 = 1.7;
/// Shortest length that a way is taken to have, in mean edges: run-off must not race over a very short way.
const SHORTEST: f32 = 0.3;

/// Neighbours of a vertex in the order of its ring: the target of run-off to each, and the vector to it at rest.
pub(super) type Ring = Vec<(Target, Vec3)>;

/// Pull (gravity plus wind), sideways spread (metres after one metre) and share of run-off that drops into cracks.
type Way = (Vec3, f32, f32);

/// Target of run-off: a film vertex, or the metal under an original vertex. The highest bit tells them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Target(u32);

impl Target {
    const NONE: Self = Self(u32::MAX);
    const METAL: u32 = 1 << 31;

    /// Returns the target of film vertex `v`.
    pub fn film(v: VertexId) -> Self {
        Self(v.0)
    }

    /// Returns the target of the metal under `original`.
    pub fn metal(original: VertexId) -> Self {
        Self(original.0 | Self::METAL)
    }

    /// Returns the vertex, and whether the target is the metal under it.
    pub fn vertex(self) -> (VertexId, bool) {
        (VertexId(self.0 & !Self::METAL), self.0 & Self::METAL != 0)
    }
}

/// Place of a target that is no neighbour: run-off leaves the ring there, over the lip of a crack.
const OVER_LIP: u16 = u16::MAX;
/// Place of a target that has no place of its own: it is at two places, or too far on in a huge ring.
const NO_PLACE: u16 = u16::MAX - 1;

/// How much of a way is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Known {
    /// Nothing: connectivity has changed at the vertex.
    Nothing,
    /// Shares and rate: connectivity has changed at a neighbour, which may go by another name now.
    Shares,
    /// Everything.
    All,
}

/// Way of run-off from one vertex: the targets with the share of each, and how fast run-off leaves. If the shares add
/// up to less than 1, the rest drips off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outflow {
    targets: [Target; WAYS],
    shares: [f32; WAYS],
    /// Place in the ring of each target that is a neighbour.
    places: [u16; WAYS],
    known: Known,
    /// Pull along the surface divided by the length of the way, per metre. Multiplied by the speed of run-off it is the
    /// rate at which run-off leaves. It is 0 where nothing flows.
    pub rate: f32,
}

impl Outflow {
    /// A way that must be computed first.
    pub const STALE: Self = Self {
        targets: [Target::NONE; WAYS],
        shares: [0.0; WAYS],
        places: [OVER_LIP; WAYS],
        known: Known::Nothing,
        rate: 0.0,
    };
    /// A way along which nothing flows.
    const NOTHING: Self = Self { known: Known::All, ..Self::STALE };

    /// Returns whether the way, or part of it, must be computed first.
    #[inline]
    pub fn is_stale(&self) -> bool {
        self.known != Known::All
    }

    /// Notes that connectivity has changed at the vertex.
    pub fn mark_stale(&mut self) {
        self.known = Known::Nothing;
    }

    /// Notes that connectivity has changed at a neighbour. The directions to the neighbours at rest are the same, and
    /// with them shares and rate.
    pub fn mark_renamed(&mut self) {
        if self.known == Known::All {
            self.known = Known::Shares;
        }
    }

    /// Brings the targets that are neighbours up to date with `ring`. Returns false if the way must be computed as a
    /// whole.
    fn rename(&mut self, ring: &Ring) -> bool {
        if self.known == Known::Nothing || self.places.contains(&NO_PLACE) {
            return false;
        }
        for (target, &place) in self.targets.iter_mut().zip(&self.places) {
            if place != OVER_LIP
                && let Some(&(now, _)) = ring.get(usize::from(place))
            {
                *target = now;
            }
        }
        // Where a crack has closed, what were two neighbours may be one, which takes the shares of both at once.
        let (targets, mut seen) = (self.targets, 0);
        let is_twice = targets.iter().take_while(|&&target| target != Target::NONE).any(|target| {
            seen += 1;
            targets[seen..].contains(target)
        });
        if is_twice {
            return false;
        }
        self.known = Known::All;
        true
    }

    /// Returns the targets of run-off, with the share of each.
    #[inline]
    pub fn ways(&self) -> impl Iterator<Item = (Target, f32)> + '_ {
        self.targets.iter().copied().zip(self.shares).take_while(|&(target, _)| target != Target::NONE)
    }

    /// Adds `share` to the share of `target`, which is the neighbour at `place` of the ring, or beyond the lip.
    fn add(&mut self, target: Target, place: u16, share: f32) {
        if share <= 0.0 {
            return;
        }
        for ((known, sum), at) in self.targets.iter_mut().zip(&mut self.shares).zip(&mut self.places) {
            if *known == target || *known == Target::NONE {
                // The end of a crack is a neighbour on both sides of it, until it is split.
                *at = if *known == Target::NONE || *at == place { place } else { NO_PLACE };
                *known = target;
                *sum += share;
                return;
            }
        }
    }

    /// Computes what is not known of the way from film vertex `v`, which is `original` or a duplicate of it. It leads
    /// over the faces of `v`; at the upper lip of a crack it leads to the film below and into the crack. `lowest` holds
    /// the lowest film vertices that are known.
    pub fn find_on_film(
        &mut self,
        mesh: &FilmMesh,
        duplicates: &Duplicates,
        lowest: &mut [VertexId],
        original: VertexId,
        v: VertexId,
        way: Way,
        ring: &mut Ring,
    ) {
        let (pull, _, into_cracks) = way;
        let topology = &mesh.topology;
        let rest = &mesh.geometry.rest_positions;
        let to = |w: VertexId| (Target::film(w), rest[w.index()] - rest[v.index()]);
        ring.clear();
        let mut last = None;
        for h in topology.fan(v) {
            ring.push(to(topology.target(h)));
            last = Some(topology.apex(h));
        }
        let closed = topology.is_closed_fan(v);
        if let (false, Some(last)) = (closed, last) {
            ring.push(to(last));
        }
        if self.rename(ring) {
            return;
        }
        let over;
        (*self, over) = Self::along(mesh, original, ring, closed, way);
        if over <= 0.0 || self.rate == 0.0 || closed {
            return;
        }
        // At the prop's own border there is nothing on the other side to run to.
        let whole = duplicates.rest_fan(topology, original).count() == topology.fan(v).count();
        if whole && !duplicates.is_inner(topology, original) {
            return;
        }
        match duplicates.lowest_known(mesh, original, pull, lowest) {
            Some(below) if below != v => {
                self.add(Target::film(below), OVER_LIP, over * (1.0 - into_cracks));
                self.add(Target::metal(original), OVER_LIP, over * into_cracks);
            }
            _ => self.add(Target::metal(original), OVER_LIP, over),
        }
    }

    /// Computes what is not known of the way from the metal under `original`. It leads over bare metal, and onto the
    /// film where film covers the metal further down.
    pub fn find_on_metal(
        &mut self,
        mesh: &FilmMesh,
        duplicates: &Duplicates,
        lowest: &mut [VertexId],
        original: VertexId,
        way: Way,
        ring: &mut Ring,
    ) {
        let (pull, ..) = way;
        let topology = &mesh.topology;
        let rest = &mesh.geometry.rest_positions;
        let mut to = |w: VertexId| {
            let w = topology.original(w);
            let bare = duplicates.rest_fan(topology, w).any(|h| !topology.is_live(h.face()));
            let film = if bare { None } else { duplicates.lowest_known(mesh, w, pull, lowest) };
            let target = film.map_or(Target::metal(w), Target::film);
            (target, rest[w.index()] - rest[original.index()])
        };
        ring.clear();
        let mut last = None;
        for h in duplicates.rest_fan(topology, original) {
            ring.push(to(topology.target(h)));
            last = Some(topology.apex(h));
        }
        let closed = duplicates.is_inner(topology, original);
        if let (false, Some(last)) = (closed, last) {
            ring.push(to(last));
        }
        if !self.rename(ring) {
            *self = Self::along(mesh, original, ring, closed, way).0;
        }
    }

    /// Computes the way to the neighbours in `ring`. Also returns the share of run-off that leaves the ring over its
    /// open side or has no lower neighbour to run to.
    fn along(mesh: &FilmMesh, original: VertexId, ring: &Ring, closed: bool, (pull, spread, _): Way) -> (Self, f32) {
        let normal = mesh.geometry.rest_normals[original.index()];
        let tangent = pull - normal * pull.dot(normal);
        let strength = tangent.length();
        let Some(direction) = tangent.try_normalize().filter(|_| strength >= LEAST_PULL) else {
            return (Self::NOTHING, 0.0);
        };
        let side = normal.cross(direction);
        let fan = Fan { ring, closed, normal, pull };
        let straight = fan.split(direction);
        // Sideways spread that dividing run-off between two edges causes by itself: a variance for each way.
        let (mut run, mut variance) = (0.0, 0.0);
        for &(i, share) in &straight.ways {
            let way = ring.get(i).map_or(Vec3::ZERO, |&(_, way)| way);
            run += share * way.dot(direction);
            let sideways = way.dot(side);
            variance += share * sideways * sideways;
        }
        let lacking = spread * spread * run - variance;
        let mut outflow = Self::NOTHING;
        let mut over = 0.0;
        let mut take = |split: Split, weight: f32, run: &mut f32| {
            for (i, share) in split.ways {
                if let Some(&(target, way)) = ring.get(i) {
                    outflow.add(target, u16::try_from(i).map_or(NO_PLACE, |i| i.min(NO_PLACE)), share * weight);
                    *run += share * weight * way.dot(direction);
                }
            }
            over += split.over * weight;
        };
        if lacking > 0.0 && run > 0.0 {
            let turn = (lacking.sqrt() / run).min(WIDEST_TURN);
            run = 0.0;
            for side in [side, -side] {
                take(fan.split((direction + side * turn).normalize_or(direction)), 0.5, &mut run);
            }
        } else {
            run = 0.0;
            take(straight, 1.0, &mut run);
        }
        let edge = mesh.geometry.mean_edge;
        // The way over the lip of a crack is half an edge long: that far reaches the vertex's own surface.
        let run = (run + over * edge * 0.5).max(edge * SHORTEST);
        outflow.rate = if run > 0.0 { strength / run } else { 0.0 };
        (outflow, over)
    }
}

/// Shares of the run-off in one direction that go to neighbours (places in the ring), and the share that goes over the
/// open side of the ring.
#[derive(Clone, Copy, Debug)]
struct Split {
    ways: [(usize, f32); 2],
    over: f32,
}

impl Split {
    /// All run-off goes over the open side of the ring.
    const OVER: Self = Self { ways: [(usize::MAX, 0.0); 2], over: 1.0 };

    /// Returns the split in which all run-off goes to one neighbour.
    fn only(neighbour: usize) -> Self {
        Self { ways: [(neighbour, 1.0), (usize::MAX, 0.0)], over: 0.0 }
    }
}

/// Neighbours around a vertex.
struct Fan<'a> {
    ring: &'a Ring,
    closed: bool,
    normal: Vec3,
    pull: Vec3,
}

impl Fan<'_> {
    /// Returns whether a neighbour lies strictly lower.
    fn is_lower(&self, neighbour: usize) -> bool {
        self.ring.get(neighbour).is_some_and(|&(_, way)| way.dot(self.pull) > 0.0)
    }

    /// Shares run-off in `direction` between the two neighbours on either side of it, so that it keeps its direction on
    /// average. If only one of them is lower, that one takes all. If neither is, the lower neighbour nearest to the
    /// direction takes all.
    fn split(&self, direction: Vec3) -> Split {
        let Some((i, j, a, b)) = self.sector(direction) else { return self.leave(direction) };
        match (self.is_lower(i), self.is_lower(j)) {
            (true, true) => Split { ways: [(i, a / (a + b)), (j, b / (a + b))], over: 0.0 },
            (true, false) => Split::only(i),
            (false, true) => Split::only(j),
            (false, false) => self.nearest(direction).map_or(Split::OVER, |(best, _)| Split::only(best)),
        }
    }

    /// Returns the two neighbours between which `direction` lies, and its coordinates in the basis of the vectors to
    /// them.
    fn sector(&self, direction: Vec3) -> Option<(usize, usize, f32, f32)> {
        let count = self.ring.len();
        let sectors = if self.closed { count } else { count.saturating_sub(1) };
        let at = |k: usize| self.ring.get(k).map_or(Vec3::ZERO, |&(_, way)| way);
        // The side of the direction on which a neighbour lies is a coordinate in the sector before it and, with the
        // other sign, in the sector after it.
        let side = |way: Vec3| direction.cross(way).dot(self.normal);
        let mut u = at(0);
        let mut b = -side(u);
        for i in 0..sectors {
            let j = if i + 1 < count { i + 1 } else { 0 };
            let v = at(j);
            let a = side(v);
            if a >= 0.0 && b >= 0.0 && a + b > 0.0 && u.cross(v).dot(self.normal) > 0.0 {
                return Some((i, j, a, b));
            }
            (u, b) = (v, -a);
        }
        None
    }

    /// Returns the lower neighbour whose direction is nearest to `direction`, and the cosine between the two.
    fn nearest(&self, direction: Vec3) -> Option<(usize, f32)> {
        let mut best: Option<(usize, f32)> = None;
        for (i, &(_, way)) in self.ring.iter().enumerate() {
            let cosine = way.normalize_or_zero().dot(direction);
            if cosine > 0.0 && self.is_lower(i) && best.is_none_or(|(_, most)| cosine > most) {
                best = Some((i, cosine));
            }
        }
        best
    }

    /// Shares run-off in a `direction` that leads out of the ring. The square of the cosine to the nearest neighbour on
    /// the rim follows the rim, the rest goes over it.
    fn leave(&self, direction: Vec3) -> Split {
        match self.nearest(direction) {
            // A closed ring has no rim; its sectors only miss the direction where it is badly folded.
            Some((best, _)) if self.closed => Split::only(best),
            Some((best, cosine)) => {
                let share = (cosine * cosine).min(1.0);
                Split { ways: [(best, share), (usize::MAX, 0.0)], over: 1.0 - share }
            }
            None => Split::OVER,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_neighbour_on_both_sides_of_a_crack_has_no_place_of_its_own() {
        let target = |v| Target::film(VertexId(v));
        let mut way = Outflow::NOTHING;
        way.add(target(5), 0, 0.5);
        way.add(target(6), 1, 0.25);
        let mut both = way;
        both.add(target(5), 2, 0.25);
        // The neighbours go by other names now, and what was one has been split.
        let ring: Ring = [7, 8, 9].map(|v| (target(v), Vec3::X)).to_vec();
        for way in [&mut way, &mut both] {
            way.mark_renamed();
            assert!(way.is_stale());
        }
        assert!(way.rename(&ring) && !way.is_stale());
        assert!(way.ways().eq([(target(7), 0.5), (target(8), 0.25)]));
        assert!(!both.rename(&ring), "nobody knows how much goes to either side");
        let mut closed = way;
        closed.mark_renamed();
        assert!(!closed.rename(&[7, 7, 9].map(|v| (target(v), Vec3::X)).to_vec()), "they are one again");
    }
}

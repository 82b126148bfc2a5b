//! The ways of run-off from one vertex (VC 6.1, fig. 10): along gravity projected on the surface.
//!
//! The paper and the method share run-off among all lower neighbours; that fans out over a third of the ring at every
//! edge. Here it goes to the two neighbours on either side of the direction in which it runs, shared so that it keeps
//! that direction on the mean: streaks stay narrow and straight on any film. What sideways spread the edges do not
//! bring about by themselves is added by turning the direction to both sides.

use bevy_math::Vec3;

use super::{LEAST_PULL, duplicates::Duplicates};
use crate::film::{FilmMesh, VertexId};

/// Most ways from one vertex.
const WAYS: usize = 5;
/// Largest tangent of the angle by which the direction is turned to spread it.
const WIDEST_TURN: f32 = 1.7;
/// Shortest way that counts, in mean edges: run-off must not race along an edge that hardly goes down.
const SHORTEST: f32 = 0.3;

/// Neighbours in the order of the ring: where run-off to each would go, and the way there at rest.
pub(super) type Ring = Vec<(Target, Vec3)>;

/// Pull, spread and share that drops into cracks.
type Way = (Vec3, f32, f32);

/// A film vertex, or the metal under an original vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Target(u32);

impl Target {
    const NONE: Self = Self(u32::MAX);
    const METAL: u32 = 1 << 31;

    pub fn film(v: VertexId) -> Self {
        Self(v.0)
    }

    pub fn metal(original: VertexId) -> Self {
        Self(original.0 | Self::METAL)
    }

    /// The vertex, and whether it is metal.
    pub fn vertex(self) -> (VertexId, bool) {
        (VertexId(self.0 & !Self::METAL), self.0 & Self::METAL != 0)
    }
}

/// Shares of run-off from one vertex, and how fast it leaves. What the shares lack of 1 drips off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Outflow {
    targets: [Target; WAYS],
    shares: [f32; WAYS],
    /// Part of the pull along the surface, over the length of the way: per metre. Times the speed it is the rate at
    /// which run-off leaves. 0: nothing flows. Negative: not known yet.
    pub rate: f32,
}

impl Outflow {
    pub const STALE: Self = Self { targets: [Target::NONE; WAYS], shares: [0.0; WAYS], rate: -1.0 };
    const NOTHING: Self = Self { rate: 0.0, ..Self::STALE };

    pub fn is_stale(&self) -> bool {
        self.rate < 0.0
    }

    /// Where run-off goes, with the share of each.
    pub fn ways(&self) -> impl Iterator<Item = (Target, f32)> + '_ {
        self.targets.iter().copied().zip(self.shares).take_while(|&(target, _)| target != Target::NONE)
    }

    fn add(&mut self, target: Target, share: f32) {
        if share <= 0.0 {
            return;
        }
        for (known, sum) in self.targets.iter_mut().zip(&mut self.shares) {
            if *known == target || *known == Target::NONE {
                *known = target;
                *sum += share;
                return;
            }
        }
    }

    /// Ways from film vertex `v`, a copy of `original`: over its own faces, and at a crack's lip to the film below or
    /// into the crack.
    pub fn of_film(
        mesh: &FilmMesh,
        duplicates: &Duplicates,
        original: VertexId,
        v: VertexId,
        way: Way,
        ring: &mut Ring,
    ) -> Self {
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
        let (mut outflow, over) = Self::along(mesh, original, ring, closed, way);
        if over <= 0.0 || outflow.rate == 0.0 {
            return outflow;
        }
        // An edge of the prop itself: there is nothing on the other side to go to.
        let whole = duplicates.rest_fan(topology, original).count() == topology.fan(v).count();
        if whole && !closed && !duplicates.is_inner(topology, original) {
            return outflow;
        }
        if closed {
            return outflow;
        }
        match duplicates.lowest(mesh, original, pull) {
            Some(below) if below != v => {
                outflow.add(Target::film(below), over * (1.0 - into_cracks));
                outflow.add(Target::metal(original), over * into_cracks);
            }
            _ => outflow.add(Target::metal(original), over),
        }
        outflow
    }

    /// Ways from the metal under `original`: over bare metal, and where film covers it further down, out onto the film.
    pub fn of_metal(mesh: &FilmMesh, duplicates: &Duplicates, original: VertexId, way: Way, ring: &mut Ring) -> Self {
        let (pull, ..) = way;
        let topology = &mesh.topology;
        let rest = &mesh.geometry.rest_positions;
        let to = |w: VertexId| {
            let w = topology.original(w);
            let bare = duplicates.rest_fan(topology, w).any(|h| !topology.is_live(h.face()));
            let target = match duplicates.lowest(mesh, w, pull) {
                Some(film) if !bare => Target::film(film),
                _ => Target::metal(w),
            };
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
        Self::along(mesh, original, ring, closed, way).0
    }

    /// Ways to the neighbours in `ring`, and the share that leaves the ring over its open side or finds no way down.
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
        // Spread that the edges bring about by themselves, as variance a way.
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
                    outflow.add(target, share * weight);
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
        // Over the lip it is half an edge: the part of the vertex's own surface.
        let run = (run + over * edge * 0.5).max(edge * SHORTEST);
        outflow.rate = if run > 0.0 { strength / run } else { 0.0 };
        (outflow, over)
    }
}

/// How run-off in one direction is shared among neighbours; what is left goes over the open side of the ring.
#[derive(Clone, Copy, Debug)]
struct Split {
    ways: [(usize, f32); 2],
    over: f32,
}

impl Split {
    const OVER: Self = Self { ways: [(usize::MAX, 0.0); 2], over: 1.0 };

    fn only(neighbour: usize) -> Self {
        Self { ways: [(neighbour, 1.0), (usize::MAX, 0.0)], over: 0.0 }
    }
}

/// The neighbours around a vertex.
struct Fan<'a> {
    ring: &'a Ring,
    closed: bool,
    normal: Vec3,
    pull: Vec3,
}

impl Fan<'_> {
    /// Whether a neighbour lies strictly lower.
    fn is_lower(&self, neighbour: usize) -> bool {
        self.ring.get(neighbour).is_some_and(|&(_, way)| way.dot(self.pull) > 0.0)
    }

    /// Shares run-off in `direction` between the two neighbours on either side of it, so that their mean is that
    /// direction. Where only one of them is lower it takes all; where neither is, the one that lies best.
    fn split(&self, direction: Vec3) -> Split {
        let Some((i, j, a, b)) = self.sector(direction) else { return self.leave(direction) };
        match (self.is_lower(i), self.is_lower(j)) {
            (true, true) => Split { ways: [(i, a / (a + b)), (j, b / (a + b))], over: 0.0 },
            (true, false) => Split::only(i),
            (false, true) => Split::only(j),
            (false, false) => self.best(direction).map_or(Split::OVER, |(best, _)| Split::only(best)),
        }
    }

    /// The neighbours between which `direction` lies, and its coordinates along the ways to them.
    fn sector(&self, direction: Vec3) -> Option<(usize, usize, f32, f32)> {
        let count = self.ring.len();
        let sectors = if self.closed { count } else { count.saturating_sub(1) };
        (0..sectors).find_map(|i| {
            let j = (i + 1) % count;
            let [u, v] = [i, j].map(|k| self.ring.get(k).map_or(Vec3::ZERO, |&(_, way)| way));
            let area = u.cross(v).dot(self.normal);
            let (a, b) = (direction.cross(v).dot(self.normal), u.cross(direction).dot(self.normal));
            (area > 0.0 && a >= 0.0 && b >= 0.0 && a + b > 0.0).then_some((i, j, a, b))
        })
    }

    /// The lower neighbour that lies best in `direction`, and the cosine.
    fn best(&self, direction: Vec3) -> Option<(usize, f32)> {
        let mut best: Option<(usize, f32)> = None;
        for (i, &(_, way)) in self.ring.iter().enumerate() {
            let cosine = way.normalize_or_zero().dot(direction);
            if cosine > 0.0 && self.is_lower(i) && best.is_none_or(|(_, most)| cosine > most) {
                best = Some((i, cosine));
            }
        }
        best
    }

    /// The direction leads out of the ring: run-off follows the rim as far as that goes its way, and leaves over it for
    /// the rest.
    fn leave(&self, direction: Vec3) -> Split {
        match self.best(direction) {
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

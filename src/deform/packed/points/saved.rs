//! Codes the points of a film for snapshots.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use bevy_math::Vec3;

use super::{Motion, Point, PointOffset, Points, xyz};
use crate::{
    coding::{Coder, Damage, Differences, number},
    film::{Topology, VertexId},
};

impl Points {
    /// Codes where the points of a film are and which of them move. To read, begin with those of a fresh film.
    /// `positions` are those of the film, and `is_attached` says which vertices the metal holds.
    ///
    /// # Errors
    /// [`Damage`] if the points that are read do not fit the film.
    pub fn code_state<C: Coder>(
        &mut self,
        topology: &Topology,
        positions: &[Vec3],
        is_attached: impl Fn(usize) -> bool,
        coder: &mut C,
    ) -> Result<(), Damage> {
        if C::READS {
            // Duplicates get their points in the order in which they were made.
            for v in topology.all_vertices().skip(topology.original_vertex_count()) {
                self.duplicate(topology.original(v).index());
            }
        }
        self.code_motions(topology, is_attached, coder)?;
        let scale = 1.0 / self.unit;
        let (mut now, mut before): ([Differences; 3], [Differences; 3]) = Default::default();
        let mut masses: [Differences; 2] = Default::default();
        for ((&motion, offset), &position) in self.motions.iter().zip(&self.offsets).zip(positions) {
            let i = offset.index();
            let mass = if motion == Motion::Awake { 1.0 } else { 0.0 };
            let point = (self.now.get_mut(i), self.before.get_mut(i));
            let (Some(here), Some(there)) = point else { return Err(Damage("a point")) };
            code_point(here, position * scale, mass, &mut now, &mut masses[0], coder);
            code_point(there, xyz(*here), mass, &mut before, &mut masses[1], coder);
        }
        self.code_awake(coder)
    }

    fn code_motions<C: Coder>(
        &mut self,
        topology: &Topology,
        is_attached: impl Fn(usize) -> bool,
        coder: &mut C,
    ) -> Result<(), Damage> {
        const MOTIONS: [Motion; 4] = [Motion::Attached, Motion::Asleep, Motion::Awake, Motion::Gone];
        let (mut held, mut free, mut before) = (Differences::default(), Differences::default(), Motion::Awake);
        for (i, motion) in self.motions.iter_mut().enumerate() {
            let (list, expected) = if !topology.has_faces(VertexId::new(i)) {
                (&mut held, Motion::Gone)
            } else if is_attached(i) {
                (&mut held, Motion::Attached)
            } else {
                (&mut free, before)
            };
            let is_free = !matches!(expected, Motion::Gone | Motion::Attached);
            let mut number = *motion as u32;
            coder.word(list, &mut number, expected as u32);
            *motion = *MOTIONS.get(number as usize).ok_or(Damage("the motion of a vertex"))?;
            if is_free && !matches!(motion, Motion::Gone | Motion::Attached) {
                before = *motion;
            }
        }
        self.asleep = self.motions.iter().filter(|&&motion| motion == Motion::Asleep).count();
        Ok(())
    }

    /// Codes the lists of awake points: those that woke since the last tick are at the ends.
    fn code_awake<C: Coder>(&mut self, coder: &mut C) -> Result<(), Damage> {
        let mut all: Vec<Vec<PointOffset>> = vec![Vec::new(); self.awake.len()];
        for ((motion, &region), &offset) in self.motions.iter().zip(&self.region_of).zip(&self.offsets) {
            if *motion == Motion::Awake {
                all.get_mut(usize::from(region)).ok_or(Damage("a region"))?.push(offset);
            }
        }
        let mut list = Differences::default();
        for (awake, mut all) in self.awake.iter_mut().zip(all) {
            all.sort_unstable();
            let known = awake.offsets.get(..awake.count).unwrap_or_default();
            let in_order = known.array_windows().take_while(|[a, b]| a < b).count();
            let late = known.get(in_order + 1..).unwrap_or_default().to_vec();
            let count = coder.length(late.len(), all.len(), "the points that are awake")?;
            let mut offsets = late;
            offsets.resize(count, PointOffset::NULL);
            for offset in &mut offsets {
                let mut place = number(all.binary_search(offset).unwrap_or_default());
                coder.word(&mut list, &mut place, 0);
                *offset = *all.get(place as usize).ok_or(Damage("the points that are awake"))?;
            }
            let sorted = coder.plain(u32::from(awake.sorted), 1) != 0;
            if C::READS {
                let mut late = offsets.clone();
                late.sort_unstable();
                all.retain(|offset| late.binary_search(offset).is_err());
                all.append(&mut offsets);
                awake.count = all.len();
                awake.offsets = all;
                awake.sorted = sorted;
                awake.pad();
            }
        }
        Ok(())
    }
}

fn code_point<C: Coder>(
    point: &mut Point,
    expected: Vec3,
    mass: f32,
    lists: &mut [Differences; 3],
    masses: &mut Differences,
    coder: &mut C,
) {
    let mut place = xyz(*point);
    coder.vector(lists, &mut place, expected);
    let mut w = point.0[3];
    coder.float(masses, &mut w, mass);
    *point = Point(place.extend(w).to_array());
}

//! Follows the stains of one part, and colours those vertices whose look has changed.

use super::film_paint::FilmPaint;
use crate::appearance::{IndexRanges, MeshPart, PartChanges, shading::StainPart};

/// Difference of a stain below which it looks the same: about one level of 255 in colour.
const SAME_LOOK: f32 = 1.0 / 256.0;

/// Vertex attributes that carry the stains of a part's mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum StainCarrier {
    /// [`ATTRIBUTE_STAINS`](super::mesh::ATTRIBUTE_STAINS) and the places at rest.
    Attributes,
    /// Vertex colours.
    Colors,
    /// No attributes: stains are not drawn.
    #[default]
    Nothing,
}

/// Settings with which the stains of a part are drawn.
#[derive(Clone, Copy)]
pub(super) struct StainWriter<'a> {
    /// Kind of the part.
    pub part: StainPart,
    /// Colours and patterns of the stains.
    pub paint: &'a FilmPaint,
    /// Attributes that carry the stains.
    pub carrier: StainCarrier,
    /// Mean distance between vertices, in metres.
    pub edge: f32,
}

/// Stains of one part as its mesh shows them.
#[derive(Clone, Debug, Default)]
pub(super) struct StainCanvas {
    /// Attributes that carry the stains.
    carrier: StainCarrier,
    /// Stains of each vertex as they are shown; empty where none are.
    shown: Vec<[f32; 4]>,
    /// Colour of each vertex, where colours carry the stains.
    colors: Vec<[f32; 4]>,
    /// Vertices that look different since the last [`follow`](Self::follow).
    changed: IndexRanges,
    /// Whether the mesh must get other attributes.
    relaid: bool,
    /// Whether what is shown is void.
    void: bool,
}

impl StainCanvas {
    /// Returns the canvas of a part as it is now.
    pub fn new(part: &MeshPart, writer: StainWriter) -> Self {
        let mut canvas = Self::default();
        canvas.follow(part, writer, &PartChanges::default(), true);
        canvas.relaid = false;
        canvas
    }

    /// Takes over the stains of `part` that look different from those that are shown. `changes` are those of the part
    /// since the last time; with `repainted`, everything that was drawn is void.
    pub fn follow(&mut self, part: &MeshPart, writer: StainWriter, changes: &PartChanges, repainted: bool) {
        let Self { carrier, shown, colors, changed, relaid, void } = self;
        changed.clear();
        let other = std::mem::replace(carrier, writer.carrier) != writer.carrier;
        *relaid |= other;
        let all = std::mem::take(void) || repainted || other || changes.whole;
        if all {
            (*shown, *colors) = (Vec::new(), Vec::new());
        }
        if *carrier == StainCarrier::Nothing {
            return;
        }
        let count = part.stains.len();
        // What is not a number has not been shown yet.
        shown.resize(count, [f32::NAN; 4]);
        if *carrier == StainCarrier::Colors {
            colors.resize(count, [1.0; 4]);
        }
        for range in changes.renewed.ranges() {
            shown[range].fill([f32::NAN; 4]);
        }
        let mut look = |i: usize| {
            let now = part.stains[i];
            if !look_different(&shown[i], &now) {
                return;
            }
            if *carrier == StainCarrier::Colors
                && let Some(sample) = part.sample(i)
            {
                let own = part.colors.get(i).copied().unwrap_or([1.0; 4]);
                colors[i] = writer.paint.color(writer.part, own, &sample, writer.edge);
            }
            shown[i] = now;
            changed.push(i);
        };
        if all {
            (0..count).for_each(look);
        } else {
            changes.renewed.ranges().chain(changes.stained.ranges()).flatten().for_each(&mut look);
        }
    }

    /// Takes everything that is shown as void, as when the vertices are others.
    #[cfg(feature = "render")]
    pub fn forget(&mut self) {
        self.void = true;
    }

    /// Returns the attributes that carry the stains.
    pub fn carrier(&self) -> StainCarrier {
        self.carrier
    }

    /// Returns the colours, where they carry the stains.
    pub fn colors(&self) -> &[[f32; 4]] {
        &self.colors
    }

    /// Returns the stains that are shown, where attributes carry them.
    pub fn stains(&self) -> &[[f32; 4]] {
        &self.shown
    }

    /// Returns the vertices that look different since the last [`follow`](Self::follow).
    pub fn changed(&self) -> &IndexRanges {
        &self.changed
    }

    /// Returns whether the mesh must get other attributes, and takes it that it has them from now on.
    pub fn take_relaid(&mut self) -> bool {
        std::mem::take(&mut self.relaid)
    }
}

/// Returns whether the stains of a vertex look different. Stains that are gone count as different from all others.
fn look_different(shown: &[f32; 4], now: &[f32; 4]) -> bool {
    // What is not a number differs.
    let differ = |(a, b): (&f32, &f32)| !((a - b).abs() <= SAME_LOOK) || (*b == 0.0 && *a != 0.0);
    shown.iter().zip(now).any(differ)
}

#[cfg(test)]
mod tests {
    use bevy::math::Vec3;

    use super::*;
    use crate::api::coating::Coating;

    fn part(stains: Vec<[f32; 4]>) -> MeshPart {
        let count = stains.len();
        let rest = (0..count).map(|i| [i as f32 * 0.01, 0.0, 0.0]).collect();
        MeshPart { stains, rest, rest_normals: vec![[0.0, 0.0, 1.0]; count], ..MeshPart::default() }
    }

    /// Changes of a part of which some vertices are stained otherwise, and some are new.
    fn changes(stained: std::ops::Range<usize>, renewed: std::ops::Range<usize>) -> PartChanges {
        let mut changes = PartChanges::default();
        changes.stained.add(stained);
        changes.renewed.add(renewed);
        changes
    }

    #[test]
    fn only_vertices_that_look_different_are_coloured_again() {
        let paint = FilmPaint::new(&Coating::default(), 7, Vec3::NEG_Y);
        let writer = StainWriter { part: StainPart::Film, paint: &paint, carrier: StainCarrier::Colors, edge: 0.01 };
        let mut stains = vec![[0.0, 0.3, 0.0, 0.0]; 40];
        let mut canvas = StainCanvas::new(&part(stains.clone()), writer);
        let before = canvas.colors().to_vec();
        stains.iter_mut().for_each(|s| s[1] += 0.003);
        let all = changes(0..40, 0..0);
        canvas.follow(&part(stains.clone()), writer, &all, false);
        assert!(canvas.changed().is_empty(), "nothing to see");
        stains.iter_mut().take(10).for_each(|s| s[1] += 0.003);
        canvas.follow(&part(stains.clone()), writer, &all, false);
        assert!(canvas.changed().ranges().flatten().eq(0..10), "small changes add up");
        let changed = before.iter().zip(canvas.colors()).filter(|(a, b)| a != b).count();
        assert_eq!(changed, 10);
        assert_eq!(canvas.colors()[..10], StainCanvas::new(&part(stains.clone()), writer).colors()[..10]);
        stains.iter_mut().for_each(|s| *s = [0.0; 4]);
        canvas.follow(&part(stains), writer, &all, false);
        assert_eq!(canvas.colors(), vec![[1.0; 4]; 40], "clean again");
    }

    #[test]
    fn new_vertices_are_coloured_and_others_keep_their_colours() {
        let paint = FilmPaint::new(&Coating::default(), 7, Vec3::NEG_Y);
        let writer = StainWriter { part: StainPart::Film, paint: &paint, carrier: StainCarrier::Colors, edge: 0.01 };
        let stains = vec![[0.0, 0.3, 0.0, 0.0]; 4];
        let mut canvas = StainCanvas::new(&part(stains[..3].to_vec()), writer);
        let [a, b, c] = canvas.colors().try_into().expect("three");
        // The second stands for another place now, and there is a fourth.
        let mut after = part(stains);
        after.rest[1] = [0.7, 0.4, 0.0];
        let mut some = changes(0..0, 1..2);
        some.renewed.add(3..4);
        canvas.follow(&after, writer, &some, false);
        assert_eq!([canvas.colors()[0], canvas.colors()[2]], [a, c]);
        assert_ne!(canvas.colors()[1], b, "it lies elsewhere");
        assert_eq!(canvas.changed().ranges().collect::<Vec<_>>(), [1..2, 3..4]);
        assert_eq!(canvas.colors(), StainCanvas::new(&after, writer).colors());
        assert!(!canvas.take_relaid());
    }

    #[test]
    fn where_no_stains_are_drawn_none_ever_change() {
        let paint = FilmPaint::new(&Coating::default(), 7, Vec3::NEG_Y);
        let writer = StainWriter { part: StainPart::Film, paint: &paint, carrier: StainCarrier::Nothing, edge: 0.01 };
        let mut canvas = StainCanvas::new(&part(vec![[0.0; 4]; 4]), writer);
        canvas.follow(&part(vec![[1.0; 4]; 4]), writer, &changes(0..4, 0..0), false);
        assert!(canvas.changed().is_empty());
        let colors = StainWriter { carrier: StainCarrier::Colors, ..writer };
        canvas.follow(&part(vec![[1.0; 4]; 4]), colors, &PartChanges::default(), false);
        assert!(canvas.take_relaid(), "the mesh needs colours");
        assert!(canvas.changed().ranges().flatten().eq(0..4));
    }
}

//! Follows the stains of one part, and colours those vertices whose look has changed.

use super::film_paint::FilmPaint;
use crate::appearance::{MeshPart, shading::StainPart};

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

/// Change of a part besides that of its stains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Renewal {
    /// No change.
    Nothing,
    /// Vertices are numbered afresh.
    Vertices,
    /// Everything that was drawn is void: the part is new, or its paint has changed.
    Everything,
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
    /// [Number](MeshPart::keys) of each coloured vertex.
    keys: Vec<u32>,
    /// Whether the mesh does not show this yet.
    changed: bool,
}

impl StainCanvas {
    /// Returns the canvas of a part as it is now.
    pub fn new(part: &MeshPart, writer: StainWriter) -> Self {
        let mut canvas = Self::default();
        canvas.follow(part, writer, Renewal::Everything);
        canvas
    }

    /// Takes over the stains of `part` that look different from those that are shown. Vertices that were numbered
    /// afresh keep their colours.
    pub fn follow(&mut self, part: &MeshPart, writer: StainWriter, renewal: Renewal) {
        let renewal = if self.carrier == writer.carrier { renewal } else { Renewal::Everything };
        self.carrier = writer.carrier;
        self.changed |= renewal != Renewal::Nothing;
        if self.carrier == StainCarrier::Nothing {
            (self.shown, self.colors, self.keys) = (Vec::new(), Vec::new(), Vec::new());
            return;
        }
        if self.carrier == StainCarrier::Attributes {
            (self.colors, self.keys) = (Vec::new(), Vec::new());
            if renewal != Renewal::Nothing
                || self.shown.len() != part.stains.len()
                || self.shown.iter().zip(&part.stains).any(|(shown, now)| look_different(shown, now))
            {
                self.shown.clone_from(&part.stains);
                self.changed = true;
            }
            return;
        }
        if renewal == Renewal::Everything {
            self.keys.clear();
        }
        if renewal != Renewal::Nothing || self.shown.len() != part.stains.len() {
            self.renumber(part);
        }
        for (i, ((shown, color), now)) in self.shown.iter_mut().zip(&mut self.colors).zip(&part.stains).enumerate() {
            if !look_different(shown, now) {
                continue;
            }
            let own = part.colors.get(i).copied().unwrap_or([1.0; 4]);
            if let Some(sample) = part.sample(i) {
                *color = writer.paint.color(writer.part, own, &sample, writer.edge);
            }
            *shown = *now;
            self.changed = true;
        }
    }

    /// Takes over the vertices of `part`. Those that were there before keep their colours.
    fn renumber(&mut self, part: &MeshPart) {
        let highest = self.keys.iter().max();
        let mut places = vec![u32::MAX; highest.map_or(0, |&highest| highest as usize + 1)];
        self.keys.iter().enumerate().for_each(|(i, &key)| places[key as usize] = i as u32);
        let old = |i: usize| {
            let place = *places.get(*part.keys.get(i)? as usize)? as usize;
            Some((*self.shown.get(place)?, *self.colors.get(place)?))
        };
        let new = |i| old(i).unwrap_or(([f32::NAN; 4], [1.0; 4]));
        (self.shown, self.colors) = (0..part.stains.len()).map(new).unzip();
        self.keys.clone_from(&part.keys);
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

    /// Returns whether there is anything that the mesh does not show yet, and takes it as shown from now on.
    pub fn take_change(&mut self) -> bool {
        std::mem::take(&mut self.changed)
    }
}

/// Returns whether the stains of a vertex look different. Stains that are gone count as different from all others.
fn look_different(shown: &[f32; 4], now: &[f32; 4]) -> bool {
    // What is not a number has not been shown yet.
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

    #[test]
    fn only_vertices_that_look_different_are_coloured_again() {
        let paint = FilmPaint::new(&Coating::default(), 7, Vec3::NEG_Y);
        let writer = StainWriter { part: StainPart::Film, paint: &paint, carrier: StainCarrier::Colors, edge: 0.01 };
        let mut stains = vec![[0.0, 0.3, 0.0, 0.0]; 40];
        let mut canvas = StainCanvas::new(&part(stains.clone()), writer);
        assert!(canvas.take_change());
        let before = canvas.colors().to_vec();
        stains.iter_mut().for_each(|s| s[1] += 0.003);
        canvas.follow(&part(stains.clone()), writer, Renewal::Nothing);
        assert!(!canvas.take_change(), "nothing to see");
        stains.iter_mut().take(10).for_each(|s| s[1] += 0.003);
        canvas.follow(&part(stains.clone()), writer, Renewal::Nothing);
        assert!(canvas.take_change(), "small changes add up");
        let changed = before.iter().zip(canvas.colors()).filter(|(a, b)| a != b).count();
        assert_eq!(changed, 10);
        assert_eq!(canvas.colors()[..10], StainCanvas::new(&part(stains.clone()), writer).colors()[..10]);
        stains.iter_mut().for_each(|s| *s = [0.0; 4]);
        canvas.follow(&part(stains), writer, Renewal::Nothing);
        assert_eq!(canvas.colors(), vec![[1.0; 4]; 40], "clean again");
    }

    #[test]
    fn vertices_keep_their_colours_when_they_are_numbered_afresh() {
        let paint = FilmPaint::new(&Coating::default(), 7, Vec3::NEG_Y);
        let writer = StainWriter { part: StainPart::Film, paint: &paint, carrier: StainCarrier::Colors, edge: 0.01 };
        let stains = vec![[0.0, 0.3, 0.0, 0.0]; 3];
        let before = MeshPart { keys: vec![4, 9, 2], ..part(stains.clone()) };
        let mut canvas = StainCanvas::new(&before, writer);
        let [a, b, c] = canvas.colors().try_into().expect("three");
        // The second has gone, another one has come.
        let after = MeshPart { keys: vec![2, 4, 30], ..part(stains.clone()) };
        canvas.follow(&after, writer, Renewal::Vertices);
        assert!(canvas.take_change());
        assert_eq!(canvas.colors()[..2], [c, a]);
        assert_ne!(canvas.colors()[2], b, "it lies elsewhere");
        assert_eq!(canvas.stains(), stains);
        canvas.follow(&after, writer, Renewal::Everything);
        assert_eq!(canvas.colors(), StainCanvas::new(&after, writer).colors());
    }

    #[test]
    fn where_no_stains_are_drawn_none_ever_change() {
        let paint = FilmPaint::new(&Coating::default(), 7, Vec3::NEG_Y);
        let writer = StainWriter { part: StainPart::Film, paint: &paint, carrier: StainCarrier::Nothing, edge: 0.01 };
        let mut canvas = StainCanvas::new(&part(vec![[0.0; 4]; 4]), writer);
        canvas.take_change();
        canvas.follow(&part(vec![[1.0; 4]; 4]), writer, Renewal::Nothing);
        assert!(!canvas.take_change());
    }
}

//! Decides which part of a prop gets which texture.

use super::{
    Base, Dressed, Encoded,
    face::{Face, LaidOut},
    sets::Sets,
    sheet::{Sheet, Stains},
    unique::unique_slots,
    unwrap::unwrap,
};
use crate::{
    bake::{coat::Prop, warning::BakeWarning},
    sim::FilmState,
};

/// Texels for a length of a flake's back, for one on its front: backs are seen less.
const BACK_DENSITY: f32 = 0.5;
/// The texture's side over the padding around charts. Two times the padding is between them, so that smaller copies,
/// down to an eighth of the side, do not mix them.
const SIDE_TO_PADDING: u32 = 256;
/// Least padding, in texels.
const LEAST_PADDING: u32 = 2;

/// Draws the textures of a prop. Slots whose own coordinates are unique keep them, each with textures of its own; all
/// else goes into one set of textures.
pub fn textured<'a>(
    dressed: &mut Dressed<'a>,
    faces: &[Face<'a>],
    prop: &Prop,
    film: &FilmState,
    stains: &Stains,
    size: u32,
) {
    let unique = unique_slots(prop, film, size);
    let is_unique = |face: &Face| face.slot.is_some_and(|slot| unique.get(slot) == Some(&true));
    let padding = (size / SIDE_TO_PADDING).max(LEAST_PADDING);
    let (readable, other): (Vec<&Face>, Vec<&Face>) = faces.iter().partition(|face| face.is_readable());
    let (in_place, together): (Vec<&Face>, Vec<&Face>) = readable.into_iter().partition(|face| is_unique(face));
    dressed.primitives.extend(other.into_iter().map(Face::untouched));

    let mut groups: Vec<Vec<LaidOut>> =
        in_place.into_iter().filter_map(|face| Some(vec![face.in_place(components(&face.part.indices))?])).collect();
    let density = |face: &&Face| if face.base == Base::Primer { BACK_DENSITY } else { 1.0 };
    let parts: Vec<_> = together.iter().map(|face| (face.part, density(face))).collect();
    match unwrap(&parts, size, padding) {
        Some(unwrapped) => {
            if together.iter().any(|face| face.needs_both_sets()) {
                dressed.warnings.push(BakeWarning::SecondCoordinates { mesh: prop.name.clone() });
            }
            groups.push(together.iter().zip(unwrapped).filter_map(|(face, own)| face.laid_out(own)).collect());
        }
        None => {
            dressed.warnings.push(BakeWarning::TooRugged { mesh: prop.name.clone(), texels: size });
            let footprint = film.mesh.geometry.mean_edge;
            dressed.primitives.extend(together.iter().map(|face| face.colored(stains, footprint)));
        }
    }
    for parts in groups.into_iter().filter(|parts| !parts.is_empty()) {
        let patches: Vec<_> = parts.iter().map(LaidOut::patch).collect();
        let sheet = Encoded::new(&Sheet::draw(&patches, stains, size, padding));
        drop(patches);
        dressed.primitives.extend(parts.into_iter().map(|part| part.primitive(dressed.sheets.len())));
        dressed.sheets.push(sheet);
    }
}

/// For each triangle the least vertex of those that it hangs together with.
fn components(indices: &[u32]) -> Vec<u32> {
    let mut sets = Sets::new(indices.iter().max().map_or(0, |&v| v as usize + 1));
    let triangles = indices.as_chunks::<3>().0;
    for &[a, b, c] in triangles {
        sets.join(a, b);
        sets.join(b, c);
    }
    triangles.iter().map(|t| sets.root(t[0])).collect()
}

//! Writes an aged model as binary glTF 2.0.
//!
//! It begins with the document that the model was read from. Each coated mesh is replaced on its node, in the node's
//! own space: the prop's own primitives become film, and primer on the backs of flakes and rusted metal beneath follow.
//! Everything else stays, at its index. Props without a document get a node each. The appearance is made by
//! [`crate::appearance`], as in a running game; stains come into it by [`super::textures`].

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

mod assemble;
mod buffer;
mod document;
mod left;
mod materials;
mod mesh;
mod pool;
mod space;
mod uses;

use std::borrow::Cow;

use serde_json::{Value, json};

use super::{
    baked::Baked,
    error::BakeError,
    stain_output::StainOutput,
    textures::{Bare, Dressed, Textures, dress},
    warning::BakeWarning,
};
use crate::{appearance::FilmAppearance, sim::FilmState};
use assemble::{assemble, finish_root};
use buffer::BinaryChunk;
use document::{Document, Spot};
use materials::Materials;
use mesh::Rebuilt;
use space::Home;

/// Makes the bytes of a .glb file. Adds what could not be done to the warnings.
///
/// # Errors
/// [`BakeError::TooLarge`]; [`BakeError::Build`] if a prop's surface is not the one that its film was built on.
pub fn aged_glb(baked: &mut Baked, stains: StainOutput) -> Result<Vec<u8>, BakeError> {
    let Baked { props, films, stopwatch, materials: library, warnings, carried, left, detail, origin, .. } = baked;
    let appearances: Vec<FilmAppearance> = stopwatch.mesh(|| {
        let pairs = props.iter().zip(films.iter());
        let shown = pairs.map(|(prop, film)| {
            let FilmState { mesh, forces, stains, .. } = film;
            FilmAppearance::with_detail(&prop.built, &prop.surface, mesh, forces, stains, *detail)
                .map_err(|source| BakeError::Build { origin: origin.clone(), mesh: prop.name.clone(), source })
        });
        shown.collect::<Result<_, _>>()
    })?;
    let bare: Vec<Bare> = props.iter().zip(&appearances).map(|(prop, own)| Bare::new(prop, own, library)).collect();
    let dressed: Vec<Dressed> = stopwatch.mesh(|| {
        let mut textures = Textures::default();
        let areas = films.iter().map(|film| f64::from(film.mesh.geometry.rest_area));
        let total: f64 = areas.clone().sum();
        let all = props.iter().zip(films.iter()).zip(appearances.iter().zip(&bare)).zip(areas);
        all.map(|(((prop, film), appearance), area)| {
            #[expect(clippy::cast_possible_truncation, reason = "a share needs no more than single precision")]
            let output = stains.for_share((area / total) as f32);
            dress(prop, film, appearance, library, &mut textures, output)
        })
        .collect()
    });
    let mut found: Vec<BakeWarning> = dressed.iter().flat_map(|dressed| dressed.warnings.iter().cloned()).collect();

    let mut document = Document::without(props, carried);
    let worn = left.iter().flat_map(|mesh| &mesh.slots).filter_map(|slot| slot.material);
    document.uses.materials.extend(worn);
    let mut materials = Materials::new(library, &document.uses, dressed.iter().flat_map(|dressed| &dressed.primitives));
    let views = std::mem::take(&mut document.views);
    let mut chunk = BinaryChunk::new(carried, views, std::mem::take(&mut document.accessors));
    let mut at_top = Vec::new();
    for (((prop, film), dressed), i) in props.iter().zip(films.iter()).zip(&dressed).zip(0..) {
        let sheets: Vec<[usize; 3]> =
            dressed.sheets.iter().map(|sheet| materials.add_sheet(&prop.name, sheet)).collect();
        let (home, space) = Home::of(prop, film);
        let spot = document.places.get(i).copied().flatten();
        let mut rebuilt = Rebuilt::new(prop, carried);
        for primitive in &dressed.primitives {
            let material = materials.of(primitive, &sheets);
            let part = space.map_or(Cow::Borrowed(&*primitive.part), |space| space.part(&primitive.part));
            rebuilt.add(primitive, chunk.primitive(&part, primitive.has, material));
        }
        found.append(&mut rebuilt.warnings);
        let name = &prop.name;
        match (home, spot) {
            (Home::Node, Some(Spot { node, mesh })) => {
                let whole = rebuilt.with_rest(document.meshes.get(mesh));
                document.put_mesh(node, mesh, whole);
            }
            (home, spot) => {
                if let Some(Spot { node, mesh }) = spot {
                    let rest = document.meshes.get(mesh).clone();
                    document.put_mesh(node, mesh, rest);
                    found.push(BakeWarning::OwnNode { mesh: name.clone() });
                }
                if rebuilt.is_empty() {
                    continue;
                }
                let mesh = document.add_mesh(rebuilt.alone(name));
                let (Home::Child(at) | Home::Scene(at)) = home else { continue };
                let mut node = json!({ "name": name, "mesh": mesh });
                if let (true, Some(fields)) = (at != bevy_math::Vec3::ZERO, node.as_object_mut()) {
                    fields.insert("translation".into(), json!(at.to_array()));
                }
                let node = document.add_node(node);
                match (home, spot) {
                    (Home::Child(_), Some(spot)) => document.add_child(spot.node, node),
                    _ => at_top.push(node),
                }
            }
        }
    }
    for mesh in left.iter() {
        let parts = left::parts(mesh);
        let own = parts.iter().map(|(part, slot)| Value::from(chunk.primitive(part, *slot, slot.material)));
        let primitives: Vec<Value> = own.collect();
        if !primitives.is_empty() {
            let index = document.add_mesh(json!({ "name": mesh.name, "primitives": primitives }));
            let node = json!({ "name": mesh.name, "mesh": index, "translation": mesh.origin.to_array() });
            at_top.push(document.add_node(node));
        }
    }
    document.add_to_scene(&at_top);
    warnings.append(&mut found);
    BakeWarning::gather(warnings);

    let mut root = document.into_root();
    materials.write(&mut chunk, &mut root);
    finish_root(&mut root, carried, library, baked.copyright.as_deref());
    let bytes = chunk.finish(&mut root);
    assemble(&root, bytes).ok_or_else(|| BakeError::TooLarge { origin: baked.origin.clone() })
}

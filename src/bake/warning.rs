//! Holds what the user of a baked model should know.

use std::mem::discriminant;

use super::printable::Printable;
use crate::{
    extras::ExtrasError,
    surface::{BuildError, BuildWarning},
};

/// Something of a model that was left out, changed or put right. Where it is about one mesh, its text begins with the
/// name of that, control characters escaped.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BakeWarning {
    /// The mesh has morph targets, which were left out.
    #[error("{}: is morphed: its base shape is aged, the targets and what animates them are left out", Printable(mesh))]
    Morphed {
        /// Name of the mesh.
        mesh: String,
    },
    /// The mesh has a skin, which it does not follow any more.
    #[error("{}: is skinned: its bind pose is aged and does not follow the skin's joints", Printable(mesh))]
    Skinned {
        /// Name of the mesh.
        mesh: String,
    },
    /// The mesh has more texture coordinates than the two sets that are kept.
    #[error(
        "{}: of its texture coordinates only those that its textures use are kept, two sets at most",
        Printable(mesh)
    )]
    ExtraTextureCoordinates {
        /// Name of the mesh.
        mesh: String,
    },
    /// The mesh has attributes that a film does not have.
    #[error("{}: vertex attributes of its own are left out on its paint", Printable(mesh))]
    ExtraAttributes {
        /// Name of the mesh.
        mesh: String,
    },
    /// Textures were left out, because the mesh has no texture coordinates for them.
    #[error("{}: textures for which it has no texture coordinates are left out: {count}", Printable(mesh))]
    TexturesWithoutCoordinates {
        /// Name of the mesh.
        mesh: String,
        /// Number of textures.
        count: usize,
    },
    /// References to textures, images or samplers that do not exist were left out.
    #[error("references to textures, images or samplers that do not exist are left out: {count}")]
    DanglingTextures {
        /// Number of references.
        count: usize,
    },
    /// Instances of a node became nodes of their own, as each ages in its own way.
    #[error(
        "{}: its instances are nodes of their own, each with a film: {count}{}",
        Printable(mesh),
        if *more { "; their attributes other than places are left out" } else { "" }
    )]
    Instances {
        /// Name of the mesh.
        mesh: String,
        /// Number of instances.
        count: usize,
        /// Whether they have attributes besides their places, which were left out.
        more: bool,
    },
    /// Nodes with meshes that do not belong to the default scene go on as they are.
    #[error("nodes with meshes outside of the default scene are left as they are: {count}")]
    OutsideScene {
        /// Number of nodes.
        count: usize,
    },
    /// Glass does not peel: alpha-blended and transmissive primitives go on as they are.
    #[error("primitives of glass (alpha-blended or transmissive) are left as they are: {count}")]
    Glass {
        /// Number of primitives.
        count: usize,
    },
    /// A pattern of [`BakeOptions::exclude`](super::BakeOptions::exclude) fits no name.
    #[error("no node, mesh or material is called {pattern:?}, so nothing is excluded by it")]
    NothingExcluded {
        /// Text of the pattern.
        pattern: String,
    },
    /// Custom properties of the mesh cannot be used, so it is left as it is.
    #[error("{}: is left as it is: {}", Printable(mesh), Printable(&cause.to_string()))]
    CustomProperties {
        /// Name of the mesh.
        mesh: String,
        /// Why they cannot be used.
        cause: ExtrasError,
    },
    /// Materials of the mesh say how it is painted, but not all alike, and a mesh has one film.
    #[error(
        "{}: its materials have different coatings, but a mesh has one film: give the object a property `coating`",
        Printable(mesh)
    )]
    MaterialPaint {
        /// Name of the mesh.
        mesh: String,
    },
    /// Other materials of material variants were left out on paint, because stains are baked into the first.
    #[error("{}: its paint has one material in all variants, as stains are baked into that", Printable(mesh))]
    Variants {
        /// Name of the mesh.
        mesh: String,
    },
    /// Extensions of primitives were left out on paint.
    #[error("{}: extensions of its primitives are left out on its paint: {names}", Printable(mesh))]
    PrimitiveExtensions {
        /// Name of the mesh.
        mesh: String,
        /// Names of the extensions.
        names: String,
    },
    /// The mesh could not be written in the space of its node, which is flat or much too far away.
    #[error("{}: its node cannot hold it (flat, or far away), so the aged mesh has a node of its own", Printable(mesh))]
    OwnNode {
        /// Name of the mesh.
        mesh: String,
    },
    /// The surface was put right while its film was built.
    #[error("{}: {warning}", Printable(mesh))]
    Build {
        /// Name of the mesh.
        mesh: String,
        /// Fault of the surface that was put right.
        warning: BuildWarning,
    },
    /// The mesh was left out, because no film can be made of it.
    #[error("{}: left out: {cause}", Printable(mesh))]
    LeftOut {
        /// Name of the mesh.
        mesh: String,
        /// Why no film can be made of it.
        cause: BuildError,
    },
    /// A material cannot be baked, so the paint that wears it is written without stains.
    #[error(
        "{}: its paint shows no stains: material {material:?} cannot be read: {}",
        Printable(mesh),
        Printable(cause)
    )]
    MaterialUnreadable {
        /// Name of the mesh.
        mesh: String,
        /// Name of the material; empty if it has none.
        material: String,
        /// Why it cannot be read.
        cause: String,
    },
    /// Textures that are not baked and use second texture coordinates were left out: the baked textures take their
    /// place.
    #[error(
        "{}: textures other than colour, metalness and normals that use second coordinates are left out",
        Printable(mesh)
    )]
    SecondCoordinates {
        /// Name of the mesh.
        mesh: String,
    },
    /// The surface falls into more charts than its textures have room for, so its stains are vertex colours.
    #[error(
        "{}: its surface is too rugged for textures of {texels} texels, so it has vertex colours; ask for larger \
         textures",
        Printable(mesh)
    )]
    TooRugged {
        /// Name of the mesh.
        mesh: String,
        /// Texels along a side of its textures.
        texels: u32,
    },
    /// A .mtl file cannot be read.
    #[error("{}: cannot be read: {}; its materials are plain paint", Printable(file), Printable(cause))]
    MaterialFile {
        /// Name of the file, as the model has it.
        file: String,
        /// Why it cannot be read.
        cause: String,
    },
    /// Statements of a .mtl file were left out.
    #[error("{file}: {count} statements cannot be read and are left out, the first in line {line}: {cause}")]
    MaterialStatements {
        /// Name of the file, as the model has it.
        file: String,
        /// Number of statements.
        count: usize,
        /// Number of the first one's line, from 1.
        line: usize,
        /// Fault of the first one.
        cause: String,
    },
    /// Materials that faces of an .obj file have are in none of its .mtl files.
    #[error("{count} materials are defined in no .mtl file and are plain paint; the first is {first:?}")]
    MaterialsUndefined {
        /// Number of materials.
        count: usize,
        /// Name of the first one.
        first: String,
    },
    /// Images that are files of their own cannot be read.
    #[error("{count} images cannot be read and do not show; the first is {first:?}: {cause}")]
    ImagesUnreadable {
        /// Number of images.
        count: usize,
        /// Path of the first one, as the model has it.
        first: String,
        /// Why that cannot be read.
        cause: String,
    },
    /// Images of a .mtl file were left out, since glTF has no place for them or they do not fit there.
    #[error("{count} images of materials have no place in glTF and are left out: {kinds}")]
    MapsLeftOut {
        /// Number of images.
        count: usize,
        /// Names of the statements, each once.
        kinds: String,
    },
    /// The same for several meshes.
    #[error("{first} (and the same for {more} more)")]
    Repeated {
        /// The warning for the first of them.
        first: Box<BakeWarning>,
        /// Number of the others.
        more: usize,
    },
}

impl BakeWarning {
    /// Returns whether two warnings say the same, of whatever meshes.
    fn is_like(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Build { warning: a, .. }, Self::Build { warning: b, .. }) => discriminant(a) == discriminant(b),
            (Self::MaterialUnreadable { material: a, .. }, Self::MaterialUnreadable { material: b, .. }) => a == b,
            (Self::NothingExcluded { pattern: a }, Self::NothingExcluded { pattern: b }) => a == b,
            _ => discriminant(self) == discriminant(other),
        }
    }

    /// Makes one warning of all that say the same, at the place of the first.
    pub(super) fn gather(warnings: &mut Vec<Self>) {
        let mut gathered: Vec<(Self, usize)> = Vec::new();
        for warning in warnings.drain(..) {
            let (warning, count) = match warning {
                Self::Repeated { first, more } => (*first, more + 1),
                one => (one, 1),
            };
            match gathered.iter_mut().find(|(first, _)| first.is_like(&warning)) {
                Some((_, all)) => *all += count,
                None => gathered.push((warning, count)),
            }
        }
        warnings.extend(gathered.into_iter().map(|(first, count)| match count {
            1 => first,
            _ => Self::Repeated { first: first.into(), more: count - 1 },
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_of_a_kind_are_one_with_a_count() {
        let skinned = |mesh: &str| BakeWarning::Skinned { mesh: mesh.into() };
        let glass = BakeWarning::Glass { count: 2 };
        let unreadable = |material: &str| BakeWarning::MaterialUnreadable {
            mesh: "m".into(),
            material: material.into(),
            cause: String::new(),
        };
        let mut warnings = vec![skinned("a"), glass.clone(), skinned("b"), unreadable("x"), unreadable("y")];
        BakeWarning::gather(&mut warnings);
        assert_eq!(warnings.len(), 4, "{warnings:?}");
        warnings.push(skinned("c"));
        BakeWarning::gather(&mut warnings);
        assert_eq!(warnings[0], BakeWarning::Repeated { first: Box::new(skinned("a")), more: 2 });
        assert_eq!(warnings[1..], [glass, unreadable("x"), unreadable("y")]);
        assert!(warnings[0].to_string().ends_with("(and the same for 2 more)"), "{}", warnings[0]);
    }

    #[test]
    fn names_cannot_colour_the_terminal() {
        let text = BakeWarning::Skinned { mesh: "a\n\u{1b}[31m".into() }.to_string();
        assert!(text.starts_with("a\\n\\u{1b}[31m: is skinned"), "{text}");
    }
}

//! Makes entities of the pieces that came off.

use bevy::{
    asset::{Assets, RenderAssetUsages},
    camera::visibility::Visibility,
    ecs::{
        entity::Entity,
        system::{Commands, Query, ResMut},
    },
    math::{Affine3A, Vec3},
    mesh::{Indices, Mesh, Mesh3d, PrimitiveTopology},
    transform::components::{GlobalTransform, Transform},
};
#[cfg(feature = "render")]
use bevy::{
    color::Color,
    ecs::{
        hierarchy::ChildOf,
        system::{Local, SystemParam},
    },
    pbr::{MeshMaterial3d, StandardMaterial},
};

#[cfg(feature = "render")]
use crate::{api::coating::Coating, display::CoatedMaterial};
use crate::{
    api::{
        debris::{CoatingDebris, FallenPieces, Flake},
        links::{CoatedBy, FilmSource},
    },
    appearance::MeshPart,
    display::FilmDisplay,
    film::FilmMesh,
};

/// Speed at which a piece leaves the prop, in world units a second for each root of a unit of its size.
const LEAVING: f32 = 0.6;
/// Fastest turning of a piece, in radians a second.
const TURNING: f32 = 6.0;

/// Makes an entity of every piece that has come off since the last frame.
pub(super) fn shed(
    mut commands: Commands,
    mut films: Query<(&CoatedBy, &mut FallenPieces, &FilmMesh, &FilmDisplay, &FilmSource, &GlobalTransform)>,
    wanted: Query<&CoatingDebris>,
    flakes: Query<&Flake>,
    mut meshes: ResMut<Assets<Mesh>>,
    #[cfg(feature = "render")] mut coats: Coats,
) {
    for (coated_by, mut pieces, mesh, display, source, transform) in &mut films {
        if pieces.counts.is_empty() {
            continue;
        }
        let pieces = std::mem::take(&mut *pieces);
        let Ok(debris) = wanted.get(coated_by.0) else { continue };
        let mut count = flakes.iter().filter(|flake| flake.root == coated_by.0).count();
        let place = source.place(transform);
        let mut rest = pieces.faces.as_slice();
        for &faces in &pieces.counts {
            let Some((faces, others)) = rest.split_at_checked(faces as usize) else { break };
            rest = others;
            let parts = display.appearance().piece(mesh, faces);
            let Some(body) = Body::of(&parts.front, &place) else { continue };
            if body.size < debris.least_size || count >= debris.most as usize {
                continue;
            }
            count += 1;
            let flake = Flake {
                root: coated_by.0,
                velocity: body.normal * (LEAVING * body.size.sqrt()),
                spin: body.spin(),
                size: body.size,
                time: 0.0,
            };
            let front = meshes.add(body.mesh_of(&parts.front, &place));
            let at = Transform::from_translation(body.centre);
            let flake = commands.spawn((flake, Mesh3d(front), at, Visibility::default())).id();
            #[cfg(feature = "render")]
            {
                let slot = source.slots.get(parts.slot).copied().unwrap_or(Entity::PLACEHOLDER);
                coats.dress(&mut commands, flake, slot, coated_by.0, meshes.add(body.mesh_of(&parts.back, &place)));
            }
            #[cfg(not(feature = "render"))]
            let _: Entity = flake;
        }
    }
}

/// A piece as a body of the world.
struct Body {
    centre: Vec3,
    normal: Vec3,
    size: f32,
}

impl Body {
    /// Measures a piece. `None` if it has no area.
    fn of(part: &MeshPart, place: &Affine3A) -> Option<Self> {
        let (mut centre, mut area_vector, mut area) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        for corners in part.positions.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|i| place.transform_point3(Vec3::from_array(corners[i])));
            let twice = (b - a).cross(c - a);
            let length = twice.length();
            centre += (a + b + c) * (length / 3.0);
            area_vector += twice;
            area += length;
        }
        let normal = area_vector.normalize_or_zero();
        (area > 0.0).then(|| Self { centre: centre / area, normal, size: (0.5 * area).sqrt() })
    }

    /// Returns a turning that differs from piece to piece: about an axis across the normal, as flakes tumble.
    fn spin(&self) -> Vec3 {
        let chance = |k: f32| {
            let x = self.centre.dot(Vec3::new(12.9898, 78.233, 37.719)) * k;
            2.0 * (x - x.floor()) - 1.0
        };
        let axis = self.normal.any_orthonormal_vector() * chance(13.7) + self.normal * (0.3 * chance(7.1));
        axis * (TURNING / (1.0 + 4.0 * self.size))
    }

    /// Returns the mesh of one side, about the centre.
    fn mesh_of(&self, part: &MeshPart, place: &Affine3A) -> Mesh {
        let position = |&p: &[f32; 3]| (place.transform_point3(Vec3::from_array(p)) - self.centre).to_array();
        let normal = |&n: &[f32; 3]| place.transform_vector3(Vec3::from_array(n)).normalize_or_zero().to_array();
        let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
        mesh.insert_attribute(Mesh::ATTRIBUTE_POSITION, part.positions.iter().map(position).collect::<Vec<_>>());
        mesh.insert_attribute(Mesh::ATTRIBUTE_NORMAL, part.normals.iter().map(normal).collect::<Vec<_>>());
        for (attribute, uvs) in [(Mesh::ATTRIBUTE_UV_0, &part.uvs), (Mesh::ATTRIBUTE_UV_1, &part.uvs_1)] {
            if !uvs.is_empty() {
                mesh.insert_attribute(attribute, uvs.clone());
            }
        }
        if !part.colors.is_empty() {
            mesh.insert_attribute(Mesh::ATTRIBUTE_COLOR, part.colors.clone());
        }
        mesh.insert_indices(Indices::U32(part.indices.clone()));
        mesh
    }
}

/// Materials of flakes: the prop's own in front, primer behind.
#[cfg(feature = "render")]
#[derive(SystemParam)]
pub(super) struct Coats<'w, 's> {
    coated: Query<'w, 's, &'static CoatedMaterial>,
    own: Query<'w, 's, &'static MeshMaterial3d<StandardMaterial>>,
    coatings: Query<'w, 's, &'static Coating>,
    materials: Option<ResMut<'w, Assets<StandardMaterial>>>,
    /// Primer that was made, by its colour and roughness.
    primers: Local<'s, Vec<((Color, f32), bevy::asset::Handle<StandardMaterial>)>>,
}

#[cfg(feature = "render")]
impl Coats<'_, '_> {
    /// Gives a flake of the primitive `slot` its materials, and its back.
    fn dress(
        &mut self,
        commands: &mut Commands,
        flake: Entity,
        slot: Entity,
        root: Entity,
        back: bevy::asset::Handle<Mesh>,
    ) {
        let worn = self.coated.get(slot).map(|coated| coated.0.clone());
        if let Ok(front) = worn.or_else(|_| self.own.get(slot).map(|own| own.0.clone())) {
            commands.entity(flake).insert(MeshMaterial3d(front));
        }
        let (Ok(coating), Some(materials)) = (self.coatings.get(root), &mut self.materials) else { return };
        let primer = &coating.shading.primer;
        let [r, g, b] = primer.color.to_array();
        let key = (Color::linear_rgb(r, g, b), primer.roughness);
        let known = self.primers.iter().find(|(known, _)| *known == key).map(|(_, handle)| handle.clone());
        let primer = known.unwrap_or_else(|| {
            let material =
                StandardMaterial { base_color: key.0, perceptual_roughness: key.1, ..StandardMaterial::default() };
            let handle = materials.add(material);
            self.primers.push((key, handle.clone()));
            handle
        });
        commands.spawn((Mesh3d(back), MeshMaterial3d(primer), Transform::default(), ChildOf(flake)));
    }
}

//! The plates: how many triangles they have, and by which rules they crack.

use crate::cli::Options;
use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_coating::prelude::*;
use bevy_coating::remesh::sample;
use bevy_coating::settings::{Rules, ScaleSettings};
use bevy_coating::surface::BuildError;

/// The paper's plates (VC, fig. 17), and one that is finer still.
const COARSE: u32 = 3_012;
const FINE: u32 = 11_488;
const FINER: u32 = 45_952;
/// Grain in metres: an edge of the coarse plate, which is one metre wide.
const GRAIN: f32 = 0.028;

#[derive(Clone, Debug)]
pub struct Plate {
    /// Of its files.
    pub name: &'static str,
    pub title: String,
    pub detail: String,
    pub triangles: u32,
    pub settings: CoatingSettings,
    /// In the picture, from the upper left.
    pub column: usize,
    pub row: usize,
}

/// All plates: the paper's rules above, rules by the grain below.
pub fn plates(options: &Options) -> [Plate; 6] {
    let plate = |name, triangles: u32, rules, alpha: Option<f32>, column, row| {
        let scale = ScaleSettings { rules, grain: GRAIN };
        let mut settings = CoatingSettings { scale, ..CoatingSettings::default() };
        // Cracks alone, without what gathers on the paint and runs down from them.
        settings.dust.rate = 0.0;
        settings.rust.emission = 0.0;
        if let Some(alpha) = alpha {
            settings.tearing.alpha = alpha;
        }
        let title = match rules {
            Rules::Paper => format!("The paper's rules, alpha {}", settings.tearing.alpha),
            Rules::Grain => format!("Rules by the grain, {:.0} mm", GRAIN * 1e3),
        };
        let detail = format!("{} triangles", thousands(triangles));
        Plate { name, title, detail, triangles, settings, column, row }
    };
    [
        plate("paper_coarse", COARSE, Rules::Paper, None, 0, 0),
        plate("paper_fine", FINE, Rules::Paper, None, 1, 0),
        plate("paper_fine_alpha", FINE, Rules::Paper, Some(options.alpha), 2, 0),
        plate("grain_coarse", COARSE, Rules::Grain, None, 0, 1),
        plate("grain_fine", FINE, Rules::Grain, None, 1, 1),
        plate("grain_finer", FINER, Rules::Grain, None, 2, 1),
    ]
}

fn thousands(n: u32) -> String {
    format!("{},{:03}", n / 1000, n % 1000)
}

impl Plate {
    pub fn coating(&self, options: &Options) -> Coating {
        Coating::new(self.settings.clone()).with_seed(options.scene.seed).with_resolution(FilmResolution::Keep)
    }

    /// The sheet of metal, of exactly these triangles.
    pub fn mesh(&self, options: &Options) -> Result<Mesh, BuildError> {
        let surface = sample::plate(self.triangles, options.scene.seed)?.surface;
        // Attributes are those of corners: each vertex has one normal and one place in the texture.
        let mut uvs = vec![Vec2::ZERO; surface.positions.len()];
        for (corner, uv) in surface.triangles.iter().flatten().zip(&surface.uvs) {
            uvs[*corner as usize] = *uv;
        }
        let normals = vec![Vec3::Z; surface.positions.len()];
        let indices = surface.triangles.into_iter().flatten().collect();
        Ok(Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, surface.positions)
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
            .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uvs)
            .with_inserted_indices(Indices::U32(indices)))
    }
}

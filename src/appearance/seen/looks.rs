//! Follows the stains of each vertex of the film and of the metal as they are shown.

use super::differences::Differences;
use crate::appearance::part::vertex_stains;
use crate::{film::FilmMesh, stain::StainFields};

/// Entry of [`MeshPart::stains`](super::MeshPart::stains) for each vertex, and whether it is another than before.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Looks {
    pub film: Look,
    /// By original vertices.
    pub metal: Look,
}

/// Stains of one layer.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Look {
    pub stains: Vec<[f32; 4]>,
    changed: Vec<bool>,
    /// Whether any vertex has changed.
    pub any: bool,
}

impl Looks {
    /// Brings the stains up to date: all if `stained`, otherwise those of new vertices only.
    pub fn follow(&mut self, mesh: &FilmMesh, fields: &StainFields, differences: &Differences, stained: bool) {
        let topology = &mesh.topology;
        let (film, metal) = (&fields.film, &fields.metal);
        let on_film = |v: usize| {
            let under = topology.originals()[v].index();
            vertex_stains(film.rust(v), film.dust[v], film.moisture[v], fields.corrosion[under])
        };
        let on_metal = |v| vertex_stains(metal.rust(v), metal.dust[v], metal.moisture[v], fields.corrosion[v]);
        let all = stained || differences.whole;
        self.film.follow(topology.vertex_count(), all, on_film);
        self.metal.follow(topology.original_vertex_count(), all, on_metal);
    }
}

impl Look {
    fn follow(&mut self, count: usize, all: bool, at: impl Fn(usize) -> [f32; 4]) {
        let Self { stains, changed, any } = self;
        if std::mem::take(any) {
            changed.fill(false);
        }
        stains.truncate(count);
        changed.truncate(count);
        if all {
            for (v, (stains, changed)) in stains.iter_mut().zip(changed.iter_mut()).enumerate() {
                let now = at(v);
                *changed = *stains != now;
                *any |= *changed;
                *stains = now;
            }
        }
        // A new vertex may look different from the one that it is a duplicate of.
        *any |= stains.len() < count;
        stains.extend((stains.len()..count).map(at));
        changed.resize(count, true);
    }

    /// Returns whether the stains of vertex `v` changed.
    #[inline]
    pub fn has_changed(&self, v: usize) -> bool {
        self.changed[v]
    }
}

//! Makes of an aged model what can be written.

use super::{baked::Baked, dump::dump_csv, error::BakeError, glb::aged_glb, stain_output::StainOutput};

impl Baked {
    /// Makes the aged model: the bytes of a .glb file, the same for the same films. Adds what could not be done to
    /// [`warnings`](Self::warnings).
    ///
    /// Each prop becomes one node, with a primitive for each of its materials on the film, primer on the backs of
    /// flakes and rusted metal beneath.
    ///
    /// # Errors
    /// [`BakeError::Options`] if textures of that size cannot be made, [`BakeError::TooLarge`] beyond 4 GiB.
    pub fn glb(&mut self, stains: StainOutput) -> Result<Vec<u8>, BakeError> {
        stains.validate()?;
        aged_glb(self, stains)
    }

    /// Lists all vertices of the films as comma-separated values under a line of names: one row a vertex, in the order
    /// of their ids. Several films share one id space: the ids of a film follow those of the film before.
    ///
    /// | column | meaning |
    /// |---|---|
    /// | `id` | id of the vertex |
    /// | `original` | id of the vertex at rest that this one is, or is a duplicate of |
    /// | `live` | 1 while a face is left at it, else 0 |
    /// | `rest_x` to `rest_z` | position at rest, in scene space |
    /// | `normal_x` to `normal_z` | unit normal at rest |
    /// | `x` to `z` | position now, in scene space |
    /// | `separated_age` | age at which it separated; empty while it is attached |
    /// | `border` | 1 on the film's border at rest and for duplicates, else 0 |
    /// | `mean_dihedral` | mean angle in radians, at rest, of the inner edges opposite to it; empty without any |
    /// | `rust_wet`, `rust_stained` | rust on the film that runs off, and that has stained it for good: layers |
    /// | `source` | 1 while rust comes out at it, else 0 |
    /// | `past_source` | 1 if rust has ever come out at it, also now, else 0 |
    /// | `dust`, `moisture` | dust and moisture on the film: 0 to 1 |
    /// | `area` | area of film that it stands for, in square metres: a third of each of its faces at rest |
    /// | `metal_wet`, `metal_stained` | rust that came to lie on the metal below: layers |
    /// | `metal_dust`, `metal_moisture` | dust and moisture on the metal: 0 to 1 |
    /// | `metal_area` | area of metal that can be stained because no film covers it, in square metres |
    /// | `corrosion` | how far the metal itself has rusted: 0 bright to 1 rusted through |
    ///
    /// A dihedral of pi is flat, above is convex. Columns from `metal_wet` on are empty for duplicates, which have no
    /// metal of their own.
    pub fn csv(&self) -> String {
        dump_csv(&self.props, &self.films)
    }
}

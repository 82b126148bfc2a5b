//! The table of all settings, grouped by stage.
//!
//! Lengths are in mean film edges unless a row says metres. Forces are in units of the initial contraction (VC's T).
//! Angles are in radians. Age 0 is fresh, and age 1 is the end of the reference run (1,000 steps in the paper). Every
//! rate is per unit age, so that the result does not depend on the number of steps. "Found by trial" marks constants
//! that the paper leaves open.

/// Hands the table to the macro `$then`. A row is `name: type = default, ends(min, max)`, where the ends are
/// `closed` (part of the range), `open` (not part of it) or `named` (numbers of the names of an enum).
macro_rules! with_stages {
    ($then:ident) => {
        $then! {
            /// Scale of cracks, relief and curls.
            scale: ScaleSettings {
                /// Rules by which fracture and curls are measured: the paper's, which count in triangles, or those that
                /// count in grains. On a film under way a change acts on what becomes of it from then on.
                rules: Rules = Rules::Grain, named(0.0, 1.0);
                /// Grain, in metres: the length by which [`Rules::Grain`] measures. Cracks lie several grains apart,
                /// and a curl's radius is about 1.6 grains. On a film whose mean edge is the grain the paper's rules
                /// give much the same. A film whose mean edge is more than two grains has a larger grain: half its mean
                /// edge. [`FilmResolution::Grain`](crate::remesh::FilmResolution::Grain) makes films as fine as their
                /// grain. On a film under way a change draws adhesion and weak edges again, and keeps the triangles.
                grain: f32 = 0.028, closed(0.000_01, 1000.0);
            }
            /// Adhesion of the film to the metal (VC 5.1). It varies over the film by Perlin noise and falls with age.
            /// A vertex separates when the bending force on it exceeds its adhesion. When the initial adhesion is
            /// changed on a film under way, it is drawn again with the film's seed; what was lost since stays lost, and
            /// what has separated stays so.
            adhesion: AdhesionSettings {
                /// Mean adhesion of a fresh film, as a force. A flat film feels a force of 1 when fresh, so separation
                /// starts where the noise falls below that. On a film under way a change raises or lowers the present
                /// adhesion by as much. Found by trial.
                mean: f32 = 2.1, closed(0.0, 100.0);
                /// Standard deviation of a fresh film's adhesion, as a force. At 0 the adhesion is the same everywhere.
                /// Where the noise makes it negative, it is 0. On a film under way a change makes weak places weaker
                /// and strong ones stronger, or the other way round. Found by trial.
                deviation: f32 = 0.70, closed(0.0, 100.0);
                /// Number of octaves of the noise. Each octave has twice the frequency and half the amplitude of the
                /// one before. On a film under way a change draws the noise again.
                octaves: u32 = 2, closed(1.0, 8.0);
                /// Number of cycles of the first octave over the longest side of the film's bounding box. More cycles
                /// make more and smaller patches of weak and strong adhesion. On a film under way a change draws the
                /// noise again. Found by trial.
                frequency: f32 = 5.0, closed(0.01, 1000.0);
                /// Wavelength of the first octave in grains, by [`Rules::Grain`], in place of `frequency`. There are at
                /// least two cycles over the longest side of the film's bounding box. On a film under way a change
                /// draws the noise again.
                wavelength: f32 = 7.2, closed(0.1, 10_000.0);
                /// Adhesion that is lost per unit age, as a force. This is VC's speed of deterioration w. On a film
                /// under way a change acts on what is lost from then on.
                decay: f32 = 1.0, closed(0.0, 100.0);
            }
            /// Bending force that lifts the film off the metal (VC 5.1, eq. 4).
            bending: BendingSettings {
                /// Ratio of the bending force to the contraction of a face, VC's k. At 1/3 the bending force on a
                /// vertex with six neighbours in a flat film is exactly the contraction of one face. On a film under
                /// way a change acts at once on what is still attached.
                gain: f32 = 1.0 / 3.0, closed(0.0, 100.0);
                /// Steepness of the sigmoid over the dihedral angle, per radian, VC's gamma (fig. 8). A larger value
                /// makes convex places separate earlier and concave ones later. At 0 the shape has no effect. On a film
                /// under way a change acts at once on what is still attached.
                gamma: f32 = 2.0, closed(0.0, 50.0);
            }
            /// Contraction of the film, binding between its faces, and cracks (VC 5.2).
            tearing: TearingSettings {
                /// Contraction force of a fresh face, VC's T. It is the unit of all forces, so it is rarely worth
                /// changing. On a film under way faces keep what they gained, and faces beside cracks the share that
                /// they kept.
                contraction: f32 = 1.0, closed(0.0, 100.0);
                /// Contraction that a face gains per unit age, as a force. An edge tears when the contraction of its
                /// two faces together exceeds its binding. On a film under way a change acts on what is gained from
                /// then on.
                contraction_growth: f32 = 1.0, closed(0.0, 100.0);
                /// Share of its contraction that a face keeps when one of its edges tears. At 1 a crack relieves
                /// nothing, and the film breaks into smaller pieces. On a film under way a change acts on later tears.
                /// Found by trial.
                contraction_kept: f32 = 0.3, closed(0.0, 1.0);
                /// Share of the contraction that a tear takes off right beside it, by [`Rules::Grain`], in place of
                /// `contraction_kept`. At 0 a crack relieves nothing. On a film under way a change acts on later
                /// tears. Found by trial.
                relief: f32 = 0.95, closed(0.0, 1.0);
                /// Distance in grains over which relief falls by the factor e, by [`Rules::Grain`]. A longer one makes
                /// fewer cracks. On a film under way a change acts on later tears. Found by trial.
                relief_reach: f32 = 0.6, closed(0.01, 10.0);
                /// Length in grains over which a crack forgets its direction, by [`Rules::Grain`]. By the paper's rules
                /// it knows that of its last edge only. On a film under way a change acts on later tears. Found by
                /// trial.
                memory: f32 = 1.8, closed(0.01, 100.0);
                /// Width in grains of the widest neck at which a flap breaks off, by [`Rules::Grain`]: a part of the
                /// film that nothing holds but this neck, and that is larger than a square of twice its width. At 0
                /// flakes may hang on the thinnest stalk. On a film under way a change acts on what tears from then
                /// on. Found by trial.
                neck_width: f32 = 1.0, closed(0.0, 10.0);
                /// Binding force of an edge. Keep it above twice the highest contraction that is reached, or all edges
                /// tear at once. On a film under way edges beside cracks keep the share that they have left. Found by
                /// trial.
                binding: f32 = 6.0, closed(0.0, 1_000_000.0);
                /// Rate at which the bound edges of a face with a torn edge lose binding, per unit age. The binding
                /// falls by the factor exp(-rate age), once for each such face at the edge. On a film under way a
                /// change acts on what is lost from then on. Found by trial.
                binding_decay: f32 = 1.3, closed(0.0, 100.0);
                /// Probability that an edge is a defect from which cracks start (VC 5.2). At 0 no edge tears unless the
                /// contraction alone exceeds the binding. On a film under way a higher value adds defects to those
                /// there are, and a lower one takes some away where nothing has torn yet.
                weak_probability: f32 = 0.01, closed(0.0, 1.0);
                /// Share of the binding that a defect has (VC 5.2). On a film under way it acts on the defects that
                /// have not torn yet.
                weak_factor: f32 = 0.001, closed(0.0, 1.0);
                /// Straightness of cracks, as a cosine (VC 5.2). An edge at the tip of a crack tears easily if the
                /// cosine of its angle to the crack's direction is above this. A higher value makes fewer and
                /// straighter cracks. On a film under way a change acts on the growth of cracks from then on.
                alpha: f32 = 0.45, open(-1.0, 1.0);
                /// Share of the binding that counts for an edge ahead of the tip of a crack (VC 5.2). Cracks stop
                /// growing if it is above the ratio of the contraction of two faces to the binding. At 1 edges at tips
                /// tear no easier than others. On a film under way a change acts on the growth of cracks from then on.
                beta: f32 = 0.20, closed(0.0, 1.0);
            }
            /// Bending of the separated film by position-based dynamics without inertia, PBD-2 (VC 4).
            deform: DeformSettings {
                /// Rate at which the target dihedral angles of separated edges become narrower, in radians per unit
                /// age. On a film under way a change wakes what has come to rest. Found by trial.
                narrowing_rate: f32 = 0.7, closed(0.0, 100.0);
                /// Largest difference between the initial and the target angle of an edge, in radians. Values of 0.2 to
                /// 0.5 curl flakes; above about 1.5 the film folds over. On a film under way a higher value lets all
                /// flakes curl on; a lower one stops those that are beyond it, but does not bend them back. Found by
                /// trial.
                bend_limit: f32 = 0.35, closed(0.0, std::f32::consts::PI);
                /// Distance in grains from a free edge over which curls fade, by [`Rules::Grain`]: at x the target
                /// angles of edges are narrowed by the share exp(-(x / reach)^2). Film that is held all around lies
                /// flat. On coarse films the reach is shorter, so that they lift no farther than fine ones. On a film
                /// under way a change acts from the next crack on. Found by trial.
                curl_reach: f32 = 2.0, closed(0.1, 1000.0);
                /// Number of plain solver sweeps per unit age. It sets how far flakes lift, since bending is a slow
                /// creep that does not come to an end within a step. At 0 the film does not bend. On a film under way a
                /// change acts from the next step on. Found by trial.
                sweeps_per_age: f32 = 10_000.0, closed(0.0, 1_000_000.0);
            }
            /// Stripping of faces that are torn off all around (VC 5.3), and the fall of loose pieces.
            stripping: StrippingSettings {
                /// Largest number of faces of a loose piece that falls off. A piece is loose if none of its vertices is
                /// attached; larger loose pieces stay. At 0 none falls, as in the paper. On a film under way a higher
                /// value lets pieces fall that hang loose already.
                fall_faces: u32 = 6, closed(0.0, 1_000_000.0);
                /// Age for which a loose piece hangs on before it falls, whatever its size, by [`Rules::Grain`], in
                /// place of `fall_faces`. On a film under way a change acts on what hangs loose already. Found by
                /// trial.
                hold: f32 = 0.02, closed(0.0, 100.0);
                /// Area that must hold a piece, in faces whose edges are one grain long, by [`Rules::Grain`]. A piece
                /// that has torn nearly off and is held by less lets go. At 0 a single vertex holds the largest piece.
                /// On a film under way a change acts on pieces that tear further. Found by trial.
                hold_area: f32 = 2.5, closed(0.0, 1000.0);
            }
            /// Rust that runs off below cracks and stains the surface on its way (VC 6.1), and rust of the metal
            /// itself. Lengths are in metres, so that streaks do not depend on the resolution of the film. On a film
            /// under way a change acts on what runs off, dries on and rusts from the next tick on; stains that are
            /// there stay.
            rust: RustSettings {
                /// Rust that the lower end of a crack gives off per unit age and metre of that crack, in layers of rust
                /// times metres (VC 6.1). At 0 no rust runs off. Found by trial.
                emission: f32 = 0.08, closed(0.0, 1000.0);
                /// Speed of run-off on a vertical surface, in metres per unit age. On a slope it is multiplied by the
                /// sine of the slope. Found by trial.
                speed: f32 = 1.5, closed(0.0, 10_000.0);
                /// Rate at which run-off dries and leaves a lasting stain, per unit age. Streaks fade over the length
                /// `speed / deposit`. Found by trial.
                deposit: f32 = 4.0, closed(0.0, 10_000.0);
                /// Sideways spread of run-off: the standard deviation in metres after a run of one metre. A film whose
                /// edges are longer than about this spreads run-off over its edge length instead.
                spread: f32 = 0.05, closed(0.0, 10.0);
                /// Share of the run-off at the upper lip of a crack that drops onto the metal in the crack. The rest
                /// crosses to the film below. Where no film is left below, all of it drops.
                into_cracks: f32 = 0.5, closed(0.0, 1.0);
                /// Rate at which bare metal rusts towards saturation, per unit age. In cracks it is half of this.
                corrosion: f32 = 4.0, closed(0.0, 1000.0);
            }
            /// Black stains: dust and soot (VC 6.2, fig. 11). Height, direction and curvature slow down or speed up the
            /// dust, each with a weight. A factor whose weight is 0 has no effect. On a film under way a change acts on
            /// the dust that gathers from the next tick on.
            dust: DustSettings {
                /// Rate at which dust gathers where no factor changes it, per unit age. At 0 there is no dust.
                rate: f32 = 1.2, closed(0.0, 1000.0);
                /// Weight of the height. The rate at the top of the prop is 1 minus this times the rate at its foot.
                height: f32 = 0.4, closed(0.0, 1.0);
                /// Weight of the direction. The rate on surfaces that face down is 1 minus this times the rate on
                /// surfaces that face up.
                direction: f32 = 0.8, closed(0.0, 1.0);
                /// Weight of the curvature. At 1 the rate is multiplied by a factor from 0.5 on sharp ridges to 1.5 in
                /// deep hollows.
                curvature: f32 = 1.0, closed(0.0, 1.0);
            }
            /// Moisture of the surfaces and its effects. There is no moisture before the first rain. An effect whose
            /// setting is 0 is switched off. On a film under way a change acts from the next tick on.
            moisture: MoistureSettings {
                /// Rate at which surfaces that face full rain get wet, per unit age.
                wetting: f32 = 60.0, closed(0.0, 10_000.0);
                /// Rate at which wet surfaces dry in the shade, per unit age.
                drying: f32 = 15.0, closed(0.0, 10_000.0);
                /// Increase of the drying rate in full sunlight. At 1 surfaces dry twice as fast there.
                sun: f32 = 1.0, closed(0.0, 100.0);
                /// Share of the drying rate that is left under flakes and in cracks.
                crevice: f32 = 0.25, closed(0.0, 1.0);
                /// Increase of the decay of adhesion where the film is wet. At 1 it decays twice as fast there.
                adhesion: f32 = 1.0, closed(0.0, 100.0);
                /// Increase of the rust that sources give off, and of the rate at which metal rusts, where it is wet.
                /// At 1 both are doubled there.
                emission: f32 = 1.0, closed(0.0, 100.0);
                /// Increase of the speed of run-off where it is wet. At 1 it is doubled there.
                travel: f32 = 0.5, closed(0.0, 100.0);
                /// Speed at which full rain washes dust along and off wet vertical surfaces, in metres per unit age. At
                /// 0 rain washes no dust away.
                wash_dust: f32 = 2.0, closed(0.0, 10_000.0);
                /// Rate at which full rain dissolves rust stains on wet surfaces, per unit age. At 0 stains never fade.
                wash_rust: f32 = 0.0, closed(0.0, 10_000.0);
            }
        }
    };
}

pub(super) use with_stages;

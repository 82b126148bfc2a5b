//! The table of all settings, one struct a stage.
//!
//! Lengths are in mean film edges, forces in units of the initial contraction (VC's T), angles in radians, time in
//! age: 0 is fresh, 1 the end of the reference run (1,000 steps in the paper). Every rate is per unit age, so that
//! the result does not depend on how many steps cover the same age. "Found by trial" marks constants that the paper
//! leaves open.

/// Hands the table to the macro `$then`. A row is `name: type = default, ends(min, max)`, where the ends are
/// `closed` (part of the range) or `open` (not part of it).
macro_rules! with_stages {
    ($then:ident) => {
        $then! {
            /// Adhesion of the film to the metal (VC 5.1): Perlin noise over the film, falling with age. A vertex
            /// separates when the bending force on it exceeds its adhesion.
            adhesion: AdhesionSettings {
                /// Mean adhesion of a fresh film, as a force. A flat film feels a force of 1 when fresh, so
                /// separation starts where the noise falls below that. Found by trial.
                mean: f32 = 2.1, closed(0.0, 100.0);
                /// Standard deviation of a fresh film's adhesion, as a force. 0: the same everywhere. Negative noise
                /// counts as 0. Found by trial.
                deviation: f32 = 0.70, closed(0.0, 100.0);
                /// Octaves of noise, each with twice the frequency and half the amplitude of the one before.
                octaves: u32 = 2, closed(1.0, 8.0);
                /// Cycles of the first octave over the longest side of the film's bounding box: how many patches of
                /// weak and strong adhesion lie side by side. Found by trial.
                frequency: f32 = 5.0, closed(0.01, 1000.0);
                /// Adhesion lost per unit age, as a force: VC's speed of deterioration w.
                decay: f32 = 1.0, closed(0.0, 100.0);
            }
            /// Bending force that lifts the film off the metal (VC 5.1, eq. 4).
            bending: BendingSettings {
                /// Bending force per contraction force, VC's k. At 1/3 a vertex of a flat film with six neighbours
                /// feels exactly the contraction of one face.
                gain: f32 = 1.0 / 3.0, closed(0.0, 100.0);
                /// Steepness of the sigmoid over the dihedral angle, per radian, VC's gamma (fig. 8): the larger, the
                /// earlier convex places separate and the later concave ones. 0: the shape has no effect.
                gamma: f32 = 2.0, closed(0.0, 50.0);
            }
            /// Contraction of the film, binding between its faces, and cracks (VC 5.2).
            tearing: TearingSettings {
                /// Contraction force of a face when fresh, VC's T: the unit of force, so rarely worth changing.
                contraction: f32 = 1.0, closed(0.0, 100.0);
                /// Contraction gained per unit age. An edge tears when the contraction of its two faces together
                /// exceeds its binding.
                contraction_growth: f32 = 1.0, closed(0.0, 100.0);
                /// Share of its contraction that a face keeps when one of its edges tears. 1: cracks relieve
                /// nothing, and the film shatters more finely. Found by trial.
                contraction_kept: f32 = 0.3, closed(0.0, 1.0);
                /// Binding force of an edge. Keep it above twice the highest contraction that is reached, or
                /// everything tears at once. Found by trial.
                binding: f32 = 6.0, closed(0.0, 1_000_000.0);
                /// Rate at which the bound edges of a face with a torn edge lose binding, by the factor
                /// exp(-rate age), once for each such face. Found by trial.
                binding_decay: f32 = 1.3, closed(0.0, 100.0);
                /// Probability that an edge is a defect from which cracks start. 0: nothing ever tears unless the
                /// contraction alone exceeds the binding. VC 5.2.
                weak_probability: f32 = 0.01, closed(0.0, 1.0);
                /// Share of the binding that a defect has. VC 5.2.
                weak_factor: f32 = 0.001, closed(0.0, 1.0);
                /// How straight cracks run, as a cosine: an edge at a crack's tip tears easily if its cosine to the
                /// crack's direction is above this. Higher: fewer and straighter cracks. VC 5.2.
                alpha: f32 = 0.45, open(-1.0, 1.0);
                /// Share of the binding that counts for an edge straight ahead of a crack's tip. Works as a
                /// threshold near the ratio of the contraction of two faces to the binding: above it cracks stall.
                /// 1: tips tear no easier. VC 5.2.
                beta: f32 = 0.20, closed(0.0, 1.0);
            }
            /// Bending of the separated film by position-based dynamics without inertia, PBD-2 (VC 4).
            deform: DeformSettings {
                /// Rate at which the target angles of separated edges narrow, in radians per unit age. Found by
                /// trial.
                narrowing_rate: f32 = 0.7, closed(0.0, 100.0);
                /// How far below its initial angle a target may narrow, in radians. 0.2 to 0.5 curls flakes; from
                /// about 1.5 the film folds over. Found by trial.
                bend_limit: f32 = 0.35, closed(0.0, std::f32::consts::PI);
                /// Relaxation per unit age, in plain solver sweeps, which sets how far flakes lift: bending is a
                /// creep that never settles. 0: the film does not bend. Found by trial.
                sweeps_per_age: f32 = 10_000.0, closed(0.0, 1_000_000.0);
            }
            /// Stripping of faces torn off all around (VC 5.3), and loose pieces.
            stripping: StrippingSettings {
                /// Pieces without any attached vertex fall off if they have at most this many faces; larger ones
                /// stay. 0: none falls, as in the paper.
                fall_faces: u32 = 6, closed(0.0, 1_000_000.0);
            }
            /// Rust that runs off below cracks and stains what it runs over, and rust of the metal itself (VC 6.1).
            /// Lengths are in metres, so that the fineness of the film does not change streaks.
            rust: RustSettings {
                /// Rust that the lower end of a crack gives off per unit age and metre of that crack, in layers of
                /// rust times metres. 0: nothing runs off. VC 6.1; found by trial.
                emission: f32 = 0.08, closed(0.0, 1000.0);
                /// Speed of run-off straight down, in metres per unit age; on a slope its sine of that. Found by
                /// trial.
                speed: f32 = 1.5, closed(0.0, 10_000.0);
                /// Rate at which run-off dries on and stains the surface for good. Streaks fade over the length
                /// speed / deposit. Found by trial.
                deposit: f32 = 4.0, closed(0.0, 10_000.0);
                /// How far run-off spreads sideways: the standard deviation in metres after one metre. Films coarser
                /// than about this spread it over their edges, whatever is set.
                spread: f32 = 0.05, closed(0.0, 10.0);
                /// Share of the run-off at a crack's upper lip that drops on the metal in the crack; the rest goes
                /// over to the film below. Where none is left below, all of it drops.
                into_cracks: f32 = 0.5, closed(0.0, 1.0);
                /// Rate at which bare metal rusts, towards saturation; half of it in cracks.
                corrosion: f32 = 4.0, closed(0.0, 1000.0);
            }
            /// Black stains: dust and soot (VC 6.2, fig. 11). Each of the three factors has a weight; with the other
            /// two at 0 it is seen alone.
            dust: DustSettings {
                /// Rate at which dust gathers where no factor slows it. 0: none.
                rate: f32 = 1.2, closed(0.0, 1000.0);
                /// How much slower it gathers at the top of the prop than at its foot: 0 not at all, 1 not at all
                /// there.
                height: f32 = 0.4, closed(0.0, 1.0);
                /// How much slower it gathers on surfaces that face down than on those that face up.
                direction: f32 = 0.8, closed(0.0, 1.0);
                /// How much faster it gathers in hollows and slower on ridges.
                curvature: f32 = 1.0, closed(0.0, 1.0);
            }
            /// Moisture and what it does. There is none before it rains; every effect can be switched off by 0.
            moisture: MoistureSettings {
                /// Rate at which surfaces that face full rain get wet.
                wetting: f32 = 60.0, closed(0.0, 10_000.0);
                /// Rate at which wet surfaces dry in the shade.
                drying: f32 = 15.0, closed(0.0, 10_000.0);
                /// How much faster they dry in full sunlight: 1 twice as fast.
                sun: f32 = 1.0, closed(0.0, 100.0);
                /// Share of the drying that is left under flakes and in cracks.
                crevice: f32 = 0.25, closed(0.0, 1.0);
                /// How much faster adhesion decays where it is wet: 1 twice as fast.
                adhesion: f32 = 1.0, closed(0.0, 100.0);
                /// How much more rust sources give off, and metal gathers, where it is wet: 1 twice as much.
                emission: f32 = 1.0, closed(0.0, 100.0);
                /// How much faster run-off travels where it is wet: 1 twice as fast.
                travel: f32 = 0.5, closed(0.0, 100.0);
                /// Speed at which full rain washes dust along and off where it is wet, in metres per unit age straight
                /// down. 0: it washes none.
                wash_dust: f32 = 2.0, closed(0.0, 10_000.0);
                /// Rate at which full rain takes stains up again where it is wet. 0: stains never fade.
                wash_rust: f32 = 0.0, closed(0.0, 10_000.0);
            }
        }
    };
}

pub(super) use with_stages;

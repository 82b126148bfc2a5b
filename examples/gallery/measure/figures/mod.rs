//! All figures of the gallery, in the paper's order.

mod bends;
mod cracks;
mod shown;
mod stained;

use super::figure::Figure;

/// All figures, in the paper's order.
pub const FIGURES: [&Figure; 14] = [
    &bends::PART,
    &bends::DISK,
    &bends::VASE,
    &stained::RUN_OFF,
    &stained::DUST,
    &cracks::CONTROL,
    &cracks::FEW,
    &shown::CLOSE,
    &shown::SIGN,
    &cracks::MODELS,
    &shown::STEERED,
    &cracks::FINENESS,
    &shown::FINE,
    &cracks::AGES,
];

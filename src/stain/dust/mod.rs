//! Settles dust and soot as black stains (VC 6.2, fig. 11).

pub(super) mod factors;
pub(super) mod rates;
pub(super) mod settle;

//! Where run-off goes from each vertex.

/// The flow graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Flow {}

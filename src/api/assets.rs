//! Looks up assets that may still be loading.

use bevy::{
    asset::{Asset, AssetServer, Assets, Handle, UntypedAssetId},
    ecs::world::World,
};

use super::error::CoatingFault;

/// Result of a look-up: `None` while something is still loading.
pub(crate) type Waited<T> = Result<Option<T>, CoatingFault>;

/// Returns the asset of `handle`; `None` while it is loading.
///
/// # Errors
/// `failed` if the asset server could not load it.
pub(crate) fn loaded<'w, A: Asset>(world: &'w World, handle: &Handle<A>, failed: CoatingFault) -> Waited<&'w A> {
    if let Some(asset) = world.get_resource::<Assets<A>>().and_then(|assets| assets.get(handle)) {
        return Ok(Some(asset));
    }
    let state = |server: &AssetServer| server.load_state(UntypedAssetId::from(handle.id())).is_failed();
    if world.get_resource::<AssetServer>().is_some_and(state) { Err(failed) } else { Ok(None) }
}

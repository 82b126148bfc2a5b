//! The bytes around the state of a film: what it is, of which film, how long, and a checksum.

use super::{
    digest::{DIGEST_BYTES, MeshName},
    error::SnapshotError,
};

/// Version of the format. Another one for every change of what is saved, in which order, or of what is expected of it.
pub const VERSION: u16 = 1;

const MAGIC: [u8; 6] = *b"bvcoat";
/// Magic, version, counts, digest, length.
const HEADER: usize = 6 + 2 + 8 + DIGEST_BYTES + 4;
const CHECKSUM: usize = 16;

/// Puts header and checksum around a state.
pub fn wrap(name: &MeshName, state: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + state.len() + CHECKSUM);
    bytes.extend(MAGIC);
    bytes.extend(VERSION.to_le_bytes());
    name.counts.iter().for_each(|count| bytes.extend(count.to_le_bytes()));
    bytes.extend(name.digest);
    bytes.extend((state.len() as u32).to_le_bytes());
    bytes.extend(state);
    let checksum = checksum(&bytes);
    bytes.extend(checksum);
    bytes
}

/// Checks header and checksum. Returns the name of the mesh, and the state.
///
/// # Errors
/// [`SnapshotError`] if these bytes are no snapshot of this version, or not whole.
pub fn unwrap(bytes: &[u8]) -> Result<(MeshName, &[u8]), SnapshotError> {
    let mut left = bytes;
    if !bytes.starts_with(&MAGIC) {
        // The beginning of a snapshot, as far as there is any of it.
        let is_cut = !bytes.is_empty() && MAGIC.starts_with(bytes);
        return Err(if is_cut { cut(bytes) } else { SnapshotError::NotASnapshot });
    }
    let _: [u8; 6] = take(&mut left, bytes)?;
    let found = u16::from_le_bytes(take(&mut left, bytes)?);
    if found != VERSION {
        return Err(SnapshotError::Version { found, known: VERSION });
    }
    let counts = [u32::from_le_bytes(take(&mut left, bytes)?), u32::from_le_bytes(take(&mut left, bytes)?)];
    let digest = take(&mut left, bytes)?;
    let length = u32::from_le_bytes(take(&mut left, bytes)?) as usize;
    let expected = (HEADER + CHECKSUM) as u64 + length as u64;
    if bytes.len() as u64 != expected {
        return Err(SnapshotError::Length { found: bytes.len(), expected });
    }
    let (state, _) = left.split_at_checked(length).ok_or_else(|| cut(bytes))?;
    let (covered, sum) = bytes.split_last_chunk::<CHECKSUM>().ok_or_else(|| cut(bytes))?;
    if checksum(covered) != *sum {
        return Err(SnapshotError::Checksum);
    }
    Ok((MeshName { digest, counts }, state))
}

fn take<const N: usize>(left: &mut &[u8], all: &[u8]) -> Result<[u8; N], SnapshotError> {
    let (first, rest) = left.split_first_chunk().ok_or_else(|| cut(all))?;
    *left = rest;
    Ok(*first)
}

fn cut(bytes: &[u8]) -> SnapshotError {
    SnapshotError::Length { found: bytes.len(), expected: (HEADER + CHECKSUM) as u64 }
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let mut sum = [0; CHECKSUM];
    let mut hasher = blake3::Hasher::new();
    hasher.update(bytes);
    hasher.finalize_xof().fill(&mut sum);
    sum
}

//! The bytes around what is saved of a film: what it is, of which film, how long, and a checksum.

use super::digest::{DIGEST_BYTES, MeshName};
use crate::coding::Damage;

/// What is saved: how its bytes begin, and the version of its format.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kind {
    pub magic: [u8; 6],
    pub version: u16,
}

/// What is wrong with bytes that are no whole ones of their kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HeaderError {
    /// They do not begin as this kind does.
    OtherKind,
    /// Their version is this one.
    Version(u16),
    /// Their number and the number that they say.
    Length { found: usize, expected: u64 },
    /// They do not agree with their checksum.
    Checksum,
}

/// Magic, version, counts, digest, length.
const HEADER: usize = 6 + 2 + 8 + DIGEST_BYTES + 4;
const CHECKSUM: usize = 16;

/// Puts header and checksum around what is saved.
///
/// # Errors
/// [`Damage`] if it has 4 GiB or more, which the header cannot say.
pub(crate) fn wrap(kind: Kind, name: &MeshName, content: &[u8]) -> Result<Vec<u8>, Damage> {
    let length = u32::try_from(content.len()).map_err(|_| Damage("its size of 4 GiB or more"))?;
    let mut bytes = Vec::with_capacity(HEADER + content.len() + CHECKSUM);
    bytes.extend(kind.magic);
    bytes.extend(kind.version.to_le_bytes());
    name.counts.iter().for_each(|count| bytes.extend(count.to_le_bytes()));
    bytes.extend(name.digest);
    bytes.extend(length.to_le_bytes());
    bytes.extend(content);
    let checksum = checksum(&bytes);
    bytes.extend(checksum);
    Ok(bytes)
}

/// Checks header and checksum. Returns the name of the mesh, and what is saved.
///
/// # Errors
/// [`HeaderError`] if these bytes are none of this kind and version, or not whole.
pub(crate) fn unwrap(kind: Kind, bytes: &[u8]) -> Result<(MeshName, &[u8]), HeaderError> {
    let mut left = bytes;
    if !bytes.starts_with(&kind.magic) {
        // The beginning of the right bytes, as far as there is any of it.
        let is_cut = !bytes.is_empty() && kind.magic.starts_with(bytes);
        return Err(if is_cut { cut(bytes) } else { HeaderError::OtherKind });
    }
    let _: [u8; 6] = take(&mut left, bytes)?;
    let found = u16::from_le_bytes(take(&mut left, bytes)?);
    if found != kind.version {
        return Err(HeaderError::Version(found));
    }
    let counts = [u32::from_le_bytes(take(&mut left, bytes)?), u32::from_le_bytes(take(&mut left, bytes)?)];
    let digest = take(&mut left, bytes)?;
    let length = u32::from_le_bytes(take(&mut left, bytes)?) as usize;
    let expected = (HEADER + CHECKSUM) as u64 + length as u64;
    if bytes.len() as u64 != expected {
        return Err(HeaderError::Length { found: bytes.len(), expected });
    }
    let (content, _) = left.split_at_checked(length).ok_or_else(|| cut(bytes))?;
    let (covered, sum) = bytes.split_last_chunk::<CHECKSUM>().ok_or_else(|| cut(bytes))?;
    if checksum(covered) != *sum {
        return Err(HeaderError::Checksum);
    }
    Ok((MeshName { digest, counts }, content))
}

fn take<const N: usize>(left: &mut &[u8], all: &[u8]) -> Result<[u8; N], HeaderError> {
    let (first, rest) = left.split_first_chunk().ok_or_else(|| cut(all))?;
    *left = rest;
    Ok(*first)
}

fn cut(bytes: &[u8]) -> HeaderError {
    HeaderError::Length { found: bytes.len(), expected: (HEADER + CHECKSUM) as u64 }
}

fn checksum(bytes: &[u8]) -> [u8; CHECKSUM] {
    let mut sum = [0; CHECKSUM];
    let mut hasher = blake3::Hasher::new();
    hasher.update(bytes);
    hasher.finalize_xof().fill(&mut sum);
    sum
}

//! Fills texels around charts, so that smaller copies of a texture do not mix in what lies between charts.

use super::coverage::NOBODY;

/// For every texel the one that it copies: itself if it has an owner, else one within `reach` texels of it;
/// [`NOBODY`] where there is none.
pub fn sources(owners: &[u32], side: usize, reach: u32) -> Vec<u32> {
    let own = |(i, &owner): (usize, &u32)| if owner == NOBODY { NOBODY } else { i as u32 };
    let mut sources: Vec<u32> = owners.iter().enumerate().map(own).collect();
    let mut rim: Vec<u32> = (0..owners.len() as u32).filter(|&i| owners[i as usize] != NOBODY).collect();
    for _ in 0..reach {
        let mut next = Vec::new();
        for &i in &rim {
            let (x, y) = (i as usize % side, i as usize / side);
            let beside = [
                (x > 0).then(|| i - 1),
                (x + 1 < side).then(|| i + 1),
                (y > 0).then(|| i - side as u32),
                (y + 1 < side).then(|| i + side as u32),
            ];
            for j in beside.into_iter().flatten() {
                if sources[j as usize] == NOBODY {
                    sources[j as usize] = sources[i as usize];
                    next.push(j);
                }
            }
        }
        rim = next;
    }
    sources
}

/// Fills texels from their sources, and those without any with the mean of all that have an owner.
pub fn fill<const N: usize>(texels: &mut [[u8; N]], owners: &[u32], sources: &[u32]) {
    let (mut sums, mut count) = ([0u64; N], 0u64);
    for (texel, _) in texels.iter().zip(owners).filter(|&(_, &owner)| owner != NOBODY) {
        sums.iter_mut().zip(texel).for_each(|(sum, &c)| *sum += u64::from(c));
        count += 1;
    }
    let mean = sums.map(|sum| (sum / count.max(1)) as u8);
    for i in 0..texels.len() {
        if owners[i] == NOBODY {
            texels[i] = texels.get(sources[i] as usize).copied().unwrap_or(mean);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_spread_as_far_as_they_may() {
        let mut owners = vec![NOBODY; 49];
        owners[24] = 7;
        let sources = sources(&owners, 7, 2);
        let row: Vec<bool> = (21..28).map(|i| sources[i] == 24).collect();
        assert_eq!(row, [false, true, true, true, true, true, false]);
        assert_eq!(sources.iter().filter(|&&s| s == 24).count(), 13);
        let mut texels = vec![[0u8; 2]; 49];
        texels[24] = [9, 4];
        fill(&mut texels, &owners, &sources);
        assert!(texels.iter().all(|&t| t == [9, 4]), "the mean of one is that one");
    }
}

//! Keys: 64-bit names of parts and purposes.

/// Scrambles 64 bits; a bijection in which each input bit flips each output bit half the time.
///
/// The finalizer of SplitMix64 after one step of its counter, so that 0 does not stay 0.
/// Source: Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators",
/// OOPSLA '14, figure 20 (constants: Stafford's mix 13).
#[must_use]
pub const fn mix(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The 64-bit key of a path such as `"bee-17/compass"`: stable over versions and machines.
///
/// FNV-1a over the bytes, then [`mix`], since FNV leaves similar names with similar low bits.
#[must_use]
pub const fn path_key(path: &str) -> u64 {
    let bytes = path.as_bytes();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut i = 0;
    while i < bytes.len() {
        hash = (hash ^ bytes[i] as u64).wrapping_mul(0x0000_0100_0000_01b3);
        i += 1;
    }
    mix(hash)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mix_is_splitmix64() {
        // The first outputs of SplitMix64 seeded with 0, as printed by its reference code.
        assert_eq!(mix(0), 0xe220_a839_7b1d_cdaf);
        assert_eq!(mix(0x9e37_79b9_7f4a_7c15), 0x6e78_9e6a_a1b9_65f4);
    }

    #[test]
    fn path_keys_stay_what_they_are() {
        // Recorded runs depend on these: if this test fails, every golden trace has changed.
        assert_eq!(path_key(""), mix(0xcbf2_9ce4_8422_2325));
        assert_eq!(path_key("a"), mix(0xaf63_dc4c_8601_ec8c));
        assert_ne!(path_key("bee-1"), path_key("bee-2"));
    }
}

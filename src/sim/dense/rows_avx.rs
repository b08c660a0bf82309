//! Four rows swept at once, where the processor has AVX: all `unsafe` of the simulation is in this file.
//!
//! Every lane calculates what [`one_by_one`] does, operation by operation, without fused ones, so that finite numbers have the
//! same bits.
#![allow(unsafe_code, reason = "asks for the processor's features, and reads and writes its wide registers")]

use std::arch::x86_64::{
    __m256d, _mm256_add_pd, _mm256_loadu_pd, _mm256_max_pd, _mm256_mul_pd, _mm256_permute2f128_pd,
    _mm256_set1_pd, _mm256_storeu_pd, _mm256_sub_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd, _mm256_xor_pd,
};

use super::rows::{Four, Lanes, Rows, Swept, one_by_one};
use super::stepped::Moving;

/// One sweep over rows, or gives back what the processor cannot sweep so.
pub(super) fn sweep<'a>(rows: &Rows, is_backward: bool, swept: Swept<'a>) -> Option<Swept<'a>> {
    if !is_x86_feature_detected!("avx") {
        return Some(swept);
    }
    // SAFETY: the processor has AVX.
    unsafe { sweep_by_four(rows, is_backward, swept) };
    None
}

#[target_feature(enable = "avx")]
fn sweep_by_four(rows: &Rows, is_backward: bool, Swept { impulses, changes, moving }: Swept<'_>) {
    let fours = rows.fours(impulses, changes);
    if is_backward {
        for (four, is_apart, lanes) in fours.rev() {
            sweep_four(four, is_apart, is_backward, lanes, moving);
        }
    } else {
        for (four, is_apart, lanes) in fours {
            sweep_four(four, is_apart, is_backward, lanes, moving);
        }
    }
}

#[target_feature(enable = "avx")]
#[inline]
fn sweep_four(four: &Four, is_apart: bool, is_backward: bool, lanes: Lanes<'_>, moving: &mut [Moving]) {
    if is_apart {
        at_once(four, lanes, moving);
    } else {
        one_by_one(four, is_backward, lanes, moving);
    }
}

#[target_feature(enable = "avx")]
#[inline]
fn at_once(four: &Four, Lanes { impulses, changes }: Lanes<'_>, moving: &mut [Moving]) {
    let [first, second] = four.ends;
    let of = |bodies: [u32; 4]| transposed(bodies.map(|body| load(&moving[body as usize])));
    let ([ax, ay, az, inverse_a], [bx, by, bz, inverse_b]) = (of(first), of(second));
    let [x, y, z] = [load(&four.normal[0]), load(&four.normal[1]), load(&four.normal[2])];
    let mass = load(&four.mass);
    let pressed = |normal: __m256d, a: __m256d, b: __m256d| {
        _mm256_mul_pd(_mm256_mul_pd(normal, mass), _mm256_sub_pd(b, a))
    };
    let met = _mm256_add_pd(_mm256_add_pd(pressed(x, ax, bx), pressed(z, az, bz)), pressed(y, ay, by));
    let impulse = load(impulses);
    let least = _mm256_xor_pd(impulse, _mm256_set1_pd(-0.0));
    let change = _mm256_max_pd(_mm256_sub_pd(load(&four.target), met), least);
    store(impulses, _mm256_add_pd(impulse, change));
    store(changes, change);
    let kick = |inverse: __m256d, normal: __m256d| _mm256_mul_pd(change, _mm256_mul_pd(normal, inverse));
    let pushed = |of: __m256d, normal: __m256d| _mm256_add_pd(of, kick(inverse_b, normal));
    let pulled = |of: __m256d, normal: __m256d| _mm256_sub_pd(of, kick(inverse_a, normal));
    let others = transposed([pushed(bx, x), pushed(by, y), pushed(bz, z), inverse_b]);
    let ones = transposed([pulled(ax, x), pulled(ay, y), pulled(az, z), inverse_a]);
    for lane in 0..4 {
        store(&mut moving[second[lane] as usize], others[lane]);
    }
    for lane in 0..4 {
        store(&mut moving[first[lane] as usize], ones[lane]);
    }
}

/// Rows as columns.
#[target_feature(enable = "avx")]
#[inline]
fn transposed(rows: [__m256d; 4]) -> [__m256d; 4] {
    let (even, odd) = (_mm256_unpacklo_pd(rows[0], rows[1]), _mm256_unpackhi_pd(rows[0], rows[1]));
    let (even_after, odd_after) =
        (_mm256_unpacklo_pd(rows[2], rows[3]), _mm256_unpackhi_pd(rows[2], rows[3]));
    [
        _mm256_permute2f128_pd::<0x20>(even, even_after),
        _mm256_permute2f128_pd::<0x20>(odd, odd_after),
        _mm256_permute2f128_pd::<0x31>(even, even_after),
        _mm256_permute2f128_pd::<0x31>(odd, odd_after),
    ]
}

#[target_feature(enable = "avx")]
#[inline]
fn load(from: &[f64; 4]) -> __m256d {
    // SAFETY: four numbers lie there, and none needs to be aligned.
    unsafe { _mm256_loadu_pd(from.as_ptr()) }
}

#[target_feature(enable = "avx")]
#[inline]
fn store(to: &mut [f64; 4], four: __m256d) {
    // SAFETY: there is room for four numbers, and none needs to be aligned.
    unsafe { _mm256_storeu_pd(to.as_mut_ptr(), four) }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::rows::Rows;
    use super::super::rows::tests::{mixed, swept};
    use super::super::stepped::Contact;
    use super::sweep;

    #[test]
    fn four_at_once_have_the_bits_of_one_by_one() {
        if !is_x86_feature_detected!("avx") {
            return;
        }
        // With zeros of either sign too: bodies that just touch, along an axis.
        let touching =
            mixed().into_iter().map(|contact| Contact { normal: DVec3::NEG_Y, bound: -0.0, ..contact });
        let bits = |numbers: Vec<f64>| -> Vec<u64> { numbers.into_iter().map(f64::to_bits).collect() };
        for contacts in [mixed(), touching.collect()] {
            let at_once = swept(&contacts, 7, |rows, is_backward, of| {
                assert!(sweep(rows, is_backward, of).is_none(), "nothing was swept");
            });
            assert_eq!(bits(at_once), bits(swept(&contacts, 7, Rows::sweep_one_by_one)));
        }
    }
}

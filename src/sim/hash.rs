//! The state hash: FNV-1a over bits, to tell whether two runs are the same.

use super::model::Model;
use super::state::State;

const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;

pub(super) fn of(model: &Model, state: &State) -> u64 {
    let mut hash = OFFSET;
    let mut put = |bits: u64| {
        for byte in bits.to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(PRIME);
        }
    };
    put(state.now.to_bits());
    for body in model.present() {
        let (x, v) = (state.position(body, state.now), state.velocity(body, state.now));
        x.to_array().into_iter().chain(v.to_array()).for_each(|value| put(value.to_bits()));
        if model.plan.spin {
            let (turned, spin) = (state.orientation(body, state.now), state.spin(body, state.now));
            turned.to_array().into_iter().chain(spin.to_array()).for_each(|value| put(value.to_bits()));
        }
        put(state.contact_state(body, state.now) as u64);
    }
    hash
}

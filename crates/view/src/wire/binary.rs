//! Binary messages: frames and values, little-endian, each column aligned to its size.

/// The columns of a frame, by vehicle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns {
    /// Virtual time, s.
    pub time_s: f64,
    /// World frame (ENU), m.
    pub positions: Vec<[f32; 3]>,
    /// World frame (ENU), m/s; empty: not known.
    pub velocities: Vec<[f32; 3]>,
    /// Quaternions `w, x, y, z` from body to world, each number times 32767.
    pub attitudes: Vec<[i16; 4]>,
}

impl Columns {
    /// How many vehicles there are.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is nobody.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Forgets all, and keeps the memory.
    pub fn clear(&mut self) {
        self.positions.clear();
        self.velocities.clear();
        self.attitudes.clear();
    }

    /// A unit quaternion `w, x, y, z` as a frame has it.
    pub fn attitude([w, x, y, z]: [f64; 4]) -> [i16; 4] {
        [w, x, y, z].map(|part| {
            let scaled = part * 32767.0;
            (scaled + f64::copysign(0.5, scaled)) as i16
        })
    }
}

const FRAME: u8 = 1;
const VALUES: u8 = 2;
const WITH_VELOCITIES: u8 = 1;
const WITH_VALUES: u8 = 2;

/// A frame; `colour`: a number of each vehicle to colour it by.
pub fn frame(columns: &Columns, colour: Option<&[f32]>) -> Vec<u8> {
    let n = columns.len();
    let with_velocities = columns.velocities.len() == n && n > 0;
    let colour = colour.filter(|values| values.len() == n);
    let mut bytes = Vec::with_capacity(16 + n * 36);
    let flag = |set: bool, bit: u8| if set { bit } else { 0 };
    bytes.push(FRAME);
    bytes.push(flag(with_velocities, WITH_VELOCITIES) | flag(colour.is_some(), WITH_VALUES));
    bytes.extend([0; 2]);
    bytes.extend((n as u32).to_le_bytes());
    bytes.extend(columns.time_s.to_le_bytes());
    for position in &columns.positions {
        vector(&mut bytes, *position);
    }
    if with_velocities {
        for velocity in &columns.velocities {
            vector(&mut bytes, *velocity);
        }
    }
    for value in colour.unwrap_or_default() {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    for [w, x, y, z] in &columns.attitudes {
        let [w, x, y, z] = [w, x, y, z].map(|part| part.to_le_bytes());
        let eight = [w[0], w[1], x[0], x[1], y[0], y[1], z[0], z[1]];
        bytes.extend_from_slice(&eight);
    }
    bytes
}

fn vector(bytes: &mut Vec<u8>, xyz: [f32; 3]) {
    for part in xyz {
        bytes.extend_from_slice(&part.to_le_bytes());
    }
}

/// Values of series at one time, s: the number of each series, and its value.
pub fn values(time_s: f64, list: &[(u32, f64)]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(16 + list.len() * 12);
    bytes.push(VALUES);
    bytes.extend([0; 3]);
    bytes.extend((list.len() as u32).to_le_bytes());
    bytes.extend(time_s.to_le_bytes());
    for (_, value) in list {
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    for (id, _) in list {
        bytes.extend_from_slice(&id.to_le_bytes());
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two() -> Columns {
        Columns {
            time_s: 0.5,
            positions: vec![[1.0, 2.0, 3.0], [-1.0, 0.0, 0.25]],
            velocities: vec![[0.0, 0.0, 1.0], [0.0; 3]],
            attitudes: vec![[32767, 0, 0, 0], [0, -32767, 1, 0]],
        }
    }

    #[test]
    fn a_frame_is_these_bytes() {
        let bytes = frame(&two(), Some(&[1.0, f32::NAN]));
        #[rustfmt::skip]
        let expected: Vec<u8> = [
            vec![1, 3, 0, 0, 2, 0, 0, 0],
            vec![0, 0, 0, 0, 0, 0, 0xe0, 0x3f],
            vec![0, 0, 0x80, 0x3f, 0, 0, 0, 0x40, 0, 0, 0x40, 0x40],
            vec![0, 0, 0x80, 0xbf, 0, 0, 0, 0, 0, 0, 0x80, 0x3e],
            vec![0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x80, 0x3f],
            vec![0; 12],
            vec![0, 0, 0x80, 0x3f, 0, 0, 0xc0, 0x7f],
            vec![0xff, 0x7f, 0, 0, 0, 0, 0, 0],
            vec![0, 0, 0x01, 0x80, 1, 0, 0, 0],
        ]
        .concat();
        assert_eq!(bytes, expected);
    }

    #[test]
    fn columns_that_are_not_known_are_left_out() {
        let columns = Columns {
            velocities: Vec::new(),
            ..two()
        };
        let bytes = frame(&columns, None);
        assert_eq!(bytes[1], 0);
        assert_eq!(bytes.len(), 16 + 2 * (12 + 8));
        assert_eq!(frame(&Columns::default(), None).len(), 16);
    }

    #[test]
    fn values_are_these_bytes() {
        #[rustfmt::skip]
        let expected: Vec<u8> = [
            vec![2, 0, 0, 0, 2, 0, 0, 0],
            vec![0, 0, 0, 0, 0, 0, 0, 0x40],
            vec![0, 0, 0, 0, 0, 0, 0xf0, 0x3f],
            vec![0, 0, 0, 0, 0, 0, 0, 0xc0],
            vec![7, 0, 0, 0, 0, 1, 0, 0],
        ]
        .concat();
        assert_eq!(values(2.0, &[(7, 1.0), (256, -2.0)]), expected);
    }

    #[test]
    fn attitudes_are_rounded_and_bounded() {
        let attitude = Columns::attitude([1.0, -1.0, 0.5, 2.0]);
        assert_eq!(attitude, [32767, -32767, 16384, 32767]);
        assert_eq!(Columns::attitude([f64::NAN; 4]), [0; 4]);
    }
}

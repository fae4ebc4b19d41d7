//! What stands and hangs in rooms.

use super::stage::Stage;

/// Thickness of a board, m.
const BOARD_M: f64 = 0.03;

impl Stage {
    /// Size of a usual room, m.
    pub(super) fn room_size(&mut self) -> [f64; 3] {
        [(3.0, 6.0), (3.0, 7.0), (2.4, 3.2)].map(|(low, high)| self.draw.between(low, high))
    }

    /// A place of a plan at least so far from its border.
    pub(super) fn place(&mut self, size: [f64; 3], margin_m: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.draw.between(margin_m, size[axis] - margin_m))
    }

    /// A table on four legs whose tops touch the board, about the middle of its plan.
    pub(super) fn table(&mut self, [x, y]: [f64; 2], [a, b]: [f64; 2], height_m: f64, paint: u32) {
        let top = height_m - BOARD_M;
        self.solid(
            "table",
            [x - 0.5 * a, y - 0.5 * b, top],
            [x + 0.5 * a, y + 0.5 * b, height_m],
            paint,
        );
        for (side_x, side_y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            let [leg_x, leg_y] = [x + side_x * (0.5 * a - 0.04), y + side_y * (0.5 * b - 0.04)];
            let [low, high] = [-0.03, 0.03].map(|d| [leg_x + d, leg_y + d]);
            self.solid("leg", [low[0], low[1], 0.0], [high[0], high[1], top], paint);
        }
    }

    /// A stool: a block on a foot, askew.
    pub(super) fn stool(&mut self, [x, y]: [f64; 2], paint: u32) {
        let turn_deg = self.draw.between(0.0, 90.0);
        let around =
            |half: f64, z: [f64; 2]| ([x - half, y - half, z[0]], [x + half, y + half, z[1]]);
        let (low, high) = around(0.04, [0.0, 0.4]);
        self.turned_solid("foot", low, high, turn_deg, paint);
        let (low, high) = around(0.2, [0.4, 0.45]);
        self.turned_solid("seat", low, high, turn_deg, paint);
    }

    /// A bookcase with its back to the wall x = 0: sides, boards, and some books as blocks.
    pub(super) fn bookcase(&mut self, y: f64, size: [f64; 3], boards: u32, paint: u32) {
        let [depth, width, height] = size;
        for side_y in [y, y + width - BOARD_M] {
            self.solid("side", [0.0, side_y, 0.0], [depth, side_y + BOARD_M, height], paint);
        }
        self.solid("back", [0.0, y, 0.0], [0.01, y + width, height], paint);
        let books = self.any_paint(0.1, 0.6);
        let step = (height - BOARD_M) / f64::from(boards - 1);
        for board in 0..boards {
            let z = step * f64::from(board);
            self.solid("board", [0.0, y, z], [depth, y + width, z + BOARD_M], paint);
            if board + 1 < boards {
                let [reach, tall] = [self.draw.between(0.2, 0.9), self.draw.between(0.5, 0.95)];
                let low = [0.02, y + BOARD_M, z + BOARD_M];
                let high = [
                    0.8 * depth,
                    y + BOARD_M + reach * (width - 2.0 * BOARD_M),
                    z + BOARD_M + tall * (step - BOARD_M),
                ];
                self.solid("books", low, high, books);
            }
        }
    }

    /// A cupboard on the floor against the wall y = 0, and one on the wall above it.
    pub(super) fn cupboards(&mut self, x: f64, width_m: f64, paint: u32) {
        self.solid("cupboard", [x, 0.0, 0.0], [x + width_m, 0.6, 0.9], paint);
        self.solid("wall cupboard", [x, 0.0, 1.45], [x + width_m, 0.35, 2.1], paint);
    }

    /// A box that is open below, of sheets that reflect on both sides.
    pub(super) fn hood(&mut self, low: [f64; 3], high: [f64; 3], paint: u32) {
        self.walls([low[0], low[1]], [high[0], high[1]], [low[2], high[2]], paint);
        let [u, v] = [[0.0, high[1] - low[1], 0.0], [high[0] - low[0], 0.0, 0.0]];
        self.sheet("top", [low[0], low[1], high[2]], u, v, paint);
    }

    /// A tube about a vertical, open at both ends, front outside.
    pub(super) fn tube(&mut self, [x, y]: [f64; 2], radii_m: [f64; 2], z: [f64; 2], paint: u32) {
        const SIDES: u32 = 24;
        let on_ring = |k: u32| {
            let (s, c) = isolux::units::sincos_deg(360.0 / f64::from(SIDES) * f64::from(k));
            [c, s]
        };
        let ring = |end: usize| {
            (0..SIDES)
                .map(on_ring)
                .map(move |[c, s]| [x + radii_m[end] * c, y + radii_m[end] * s, z[end]])
        };
        let next = |k: u32| (k + 1) % SIDES;
        self.shape(isolux::scene::Shape {
            name: "shade".into(),
            positions: ring(0).chain(ring(1)).collect(),
            triangles: (0..SIDES)
                .flat_map(|k| [[k, next(k), SIDES + next(k)], [k, SIDES + next(k), SIDES + k]])
                .collect(),
            material: paint,
            ..isolux::scene::Shape::default()
        });
    }

    /// A wall in the plane of `corner`, `u` and `v` with a rectangular opening, given in metres along both.
    pub(super) fn pierced(
        &mut self,
        corner: [f64; 3],
        [u, v]: [[f64; 3]; 2],
        [from, to]: [[f64; 2]; 2],
        paint: u32,
    ) {
        let length = |e: [f64; 3]| e.iter().map(|c| c * c).sum::<f64>().sqrt();
        let [long_u, long_v] = [length(u), length(v)];
        let mut part = |[s0, s1]: [f64; 2], [t0, t1]: [f64; 2]| {
            let axis = |k: usize| corner[k] + u[k] * (s0 / long_u) + v[k] * (t0 / long_v);
            let along = |e: [f64; 3], share: f64| e.map(|c| c * share);
            let (a, b) = (along(u, (s1 - s0) / long_u), along(v, (t1 - t0) / long_v));
            if s1 > s0 && t1 > t0 {
                self.sheet("pierced wall", [0, 1, 2].map(axis), a, b, paint);
            }
        };
        part([0.0, from[0]], [0.0, long_v]);
        part([to[0], long_u], [0.0, long_v]);
        part([from[0], to[0]], [0.0, from[1]]);
        part([from[0], to[0]], [to[1], long_v]);
    }

    /// A few pieces: a table with stools, a cupboard on the floor and one on the wall, a bookcase.
    pub(super) fn furnish(&mut self, size: [f64; 3]) {
        let wood = self.any_paint(0.2, 0.6);
        let at = self.place(size, 1.1);
        self.table(at, [1.2, 0.8], 0.75, wood);
        for side in [-0.9, 0.9] {
            self.stool([at[0] + side, at[1] + 0.1], wood);
        }
        let width_m = self.draw.between(0.8, 0.5 * size[0]);
        let front = self.any_paint(0.5, 0.8);
        self.cupboards(size[0] - width_m, width_m, front);
        let case = [0.3, self.draw.between(0.6, 1.2), self.draw.between(1.2, 2.0)];
        let y = self.draw.between(0.7, size[1] - case[1]);
        self.bookcase(y, case, 4, wood);
    }
}

import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { Motion } from "../src/motion.ts";

function moved(gap: number, frames: number) {
  let [rests, slows] = [0, 0];
  const motion = new Motion(() => ++rests, () => ++slows);
  for (let k = 0; k < frames; ++k) {
    motion.frame(1000 + k * gap);
  }
  return { motion, counts: () => [rests, slows] };
}

test("what takes long is slow from then on, and is said once", () => {
  const { motion, counts } = moved(50, 30);
  assert.ok(motion.isSlow && motion.isMoving);
  assert.deepEqual(counts(), [0, 1]);
});

test("where leaving layers out is not enough, there are fewer pixels while it moves, down to half each way", () => {
  const ratios = [4, 9, 14, 40].map((frames) => moved(50, frames).motion.ratio);
  assert.deepEqual(ratios, [1, 0.75, 0.5, 0.5]);
  assert.equal(moved(16, 40).motion.ratio, 1);
});

test("at rest there are all pixels, and more of them the next time it moves when there was time left", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  const { motion } = moved(50, 40);
  mock.timers.tick(300);
  assert.equal(motion.ratio, 1);
  motion.frame(9000);
  assert.equal(motion.ratio, 0.5);
  for (let k = 1; k < 9; ++k) {
    motion.frame(9000 + 10 * k);
  }
  assert.equal(motion.ratio, 0.5, "not before it rests");
  mock.timers.tick(300);
  motion.frame(12000);
  assert.ok(motion.ratio === 0.75 && motion.isSlow);
  mock.timers.reset();
});

test("what is fluid is not slow, nor is a single pause", () => {
  const { motion } = moved(16, 30);
  motion.frame(9000);
  assert.ok(!motion.isSlow);
});

test("a change that is no motion lets nothing be slow, and ends as motion does", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  let rests = 0;
  const motion = new Motion(() => ++rests, () => assert.fail("it is not slow"));
  motion.stir();
  assert.ok(motion.isMoving && !motion.isTurning);
  for (let k = 0; k < 9; ++k) {
    mock.timers.tick(200);
    motion.stir();
  }
  assert.equal(rests, 0);
  mock.timers.tick(300);
  assert.deepEqual([rests, motion.isMoving], [1, false]);
  mock.timers.reset();
});

test("motion ends a while after the last frame", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  const { motion, counts } = moved(16, 3);
  mock.timers.tick(200);
  assert.ok(motion.isMoving);
  mock.timers.tick(100);
  assert.ok(!motion.isMoving);
  assert.deepEqual(counts(), [1, 0]);
  mock.timers.reset();
});

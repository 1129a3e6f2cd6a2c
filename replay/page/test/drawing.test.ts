import assert from "node:assert/strict";
import { mock, test } from "node:test";
import { Drawing } from "../src/drawing.ts";

/** What there is of WebGL for it; pictures are there when `signalled` says so. */
function fake() {
  const state = { signalled: false, syncs: 0, waits: 0 };
  const gl = {
    SIGNALED: 1,
    deleteSync: (sync: object | null) => (state.syncs -= sync ? 1 : 0),
    fenceSync: () => (++state.syncs, {}),
    isContextLost: () => false,
    getSyncParameter: () => (state.signalled ? 1 : 0),
  };
  return { state, drawing: new Drawing(gl as unknown as WebGL2RenderingContext, () => ++state.waits) };
}

test("it says that it waits until the picture is there, and then no more", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  const { state, drawing } = fake();
  drawing.begin();
  for (let k = 0; k < 10; ++k) {
    mock.timers.tick(50);
  }
  assert.equal(state.waits, 10);
  state.signalled = true;
  for (let k = 0; k < 10; ++k) {
    mock.timers.tick(50);
  }
  assert.equal(state.waits, 10);
  mock.timers.reset();
});

test("of several pictures it waits for the last one only", () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  const { state, drawing } = fake();
  for (let k = 0; k < 30; ++k) {
    drawing.begin();
    mock.timers.tick(10);
  }
  assert.deepEqual([state.waits, state.syncs], [0, 1]);
  mock.timers.tick(40);
  assert.equal(state.waits, 1);
  mock.timers.reset();
});

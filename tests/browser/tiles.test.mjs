// What Chromium decodes of a tile equals what Illumigraph decodes: lossless codings exactly, lossy
// ones within one code. ILLUM_TILE_CASES names the program that writes the tiles.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";

import { launch, serve } from "./chromium.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const program = process.env.ILLUM_TILE_CASES ??
                path.join(here, "../../build/release/tests/browser/illum_tile_cases");
const folder = mkdtempSync(path.join(tmpdir(), "illum-tiles-"));
execFileSync(program, [folder]);
const cases = JSON.parse(readFileSync(path.join(folder, "cases.json")));

let browser, page, server;
before(async () => {
  server = await serve(here, folder);
  browser = await launch();
  page = await browser.newPage();
  await page.goto(`${server.url}/page.html`);
  await page.waitForFunction(() => window.readBack);
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true });
});

/** Our decoder's codes: [plane][texel]. */
function expectedCodes(c) {
  const bytes = readFileSync(path.join(folder, `${c.name}.u16`));
  const texels = c.tileWidth * c.tileHeight;
  return Array.from({ length: c.planes }, (_, k) =>
    Array.from({ length: texels }, (_, i) => bytes.readUInt16LE(2 * (k * texels + i))));
}

/** Which pixel of the atlas, counted from the top left, holds a plane's texel. */
function pixelOf(c, width, plane, index, low = false) {
  const cell = Math.floor(plane / 3) + (low ? Math.ceil(c.planes / 3) : 0);
  const x = (cell % c.columns) * c.cellWidth + (index % c.tileWidth);
  const y = Math.floor(cell / c.columns) * c.cellHeight + Math.floor(index / c.tileWidth);
  return y * width + x;
}

/** The texture's value of a plane's texel; `low` asks for the low bytes' cells. */
function texelOf(c, picture, plane, index, low) {
  return picture.values[4 * pixelOf(c, picture.width, plane, index, low) + (plane % 3)];
}

/** The greatest difference between the browser's codes and ours, in codes. */
function worstError(c, picture, codeOf) {
  let worst = 0;
  expectedCodes(c).forEach((codes, plane) => codes.forEach((code, index) => {
    worst = Math.max(worst, Math.abs(codeOf(picture, plane, index) - code));
  }));
  return worst;
}

function checkSize(c, picture) {
  assert.equal(picture.width, c.columns * c.cellWidth);
  assert.equal(picture.height, c.rows * c.cellHeight);
}

for (const c of cases.filter((c) => c.coding === "png" || c.bits === 8)) {
  const lossless = c.coding === "png";
  test(`${c.name}: ${lossless ? "exactly" : "within 1"}`, async () => {
    const picture = await page.evaluate(([url]) => window.readBack(url, "bytes"), [c.file]);
    checkSize(c, picture);
    const worst = worstError(c, picture, (p, plane, index) =>
      c.split ? 256 * texelOf(c, p, plane, index, false) + texelOf(c, p, plane, index, true)
              : texelOf(c, p, plane, index, false));
    assert.ok(worst <= (lossless ? 0 : 1), `differs by ${worst} codes`);
  });
}

// Beyond 8 bits: a texture made from an ImageBitmap keeps 8 of them, whatever its format; WebCodecs
// keeps all (docs/format.md, "Browsers"). A picture with the identity matrix has green, blue, red as its planes.
const PLANE_OF_CHANNEL = [2, 0, 1];

for (const c of cases.filter((c) => c.coding === "avif" && c.bits > 8)) {
  for (const kind of ["bytes", "floats"]) {
    test(`${c.name}: a texture of ${kind} keeps 8 bits`, async () => {
      const picture = await page.evaluate(([...a]) => window.readBack(...a), [c.file, kind]);
      checkSize(c, picture);
      const peak = 2 ** c.bits - 1;
      const unit = kind === "bytes" ? peak / 255 : peak;
      const worst = worstError(c, picture, (p, plane, index) =>
        texelOf(c, p, plane, index, false) * unit);
      assert.ok(worst <= (1.01 * peak) / 255, `differs by ${worst} of ${peak}`);
    });
  }

  test(`${c.name}: WebCodecs keeps all bits, within 1`, async (context) => {
    const frame = await page.evaluate(([url]) => window.decodeFrame(url, "image/avif"), [c.file]);
    if (!frame) return context.skip("no ImageDecoder");
    assert.equal(frame.format, `I444P${c.bits}`);
    checkSize(c, frame);
    const worst = worstError(c, frame, (f, plane, index) =>
      f.planes[PLANE_OF_CHANNEL[plane % 3]][pixelOf(c, f.width, plane, index)]);
    assert.ok(worst <= 1, `differs by ${worst} codes`);
  });
}

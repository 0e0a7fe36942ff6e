// Debian's Chromium without a screen, and a server for the two folders that the pages need.

import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import path from "node:path";

import { chromium } from "playwright-core";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".json": "application/json",
                ".png": "image/png", ".jpg": "image/jpeg", ".avif": "image/avif" };

/** Serves files of `folders`, the first that has one, on a free port of this machine. */
export async function serve(...folders) {
  const server = createServer((request, answer) => {
    const name = path.basename(new URL(request.url, "http://localhost").pathname);
    const file = folders.map((folder) => path.join(folder, name)).find(existsSync);
    answer.writeHead(file ? 200 : 404,
                     { "content-type": TYPES[path.extname(name)] ?? "application/octet-stream" });
    if (file) createReadStream(file).pipe(answer);
    else answer.end();
  });
  await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
  return { url: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

export function launch() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--use-angle=swiftshader",
           "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
           "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
}

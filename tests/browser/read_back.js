// Decodes a picture as a web viewer would and reads the texture back.

const OPTIONS = { colorSpaceConversion: "none", premultiplyAlpha: "none" };

function newContext() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) throw new Error("no WebGL2");
  gl.getExtension("EXT_color_buffer_float");
  gl.pixelStorei(gl.PACK_ALIGNMENT, 1);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  return gl;
}

const FORMATS = {
  bytes: (gl) => ({ internal: gl.RGBA8, type: gl.UNSIGNED_BYTE, values: Uint8Array }),
  floats: (gl) => ({ internal: gl.RGBA32F, type: gl.FLOAT, values: Float32Array }),
};

function textureOf(gl, source, format) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, format.internal, gl.RGBA, format.type, source);
  return texture;
}

function readTexture(gl, texture, width, height, format) {
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE)
    throw new Error("this texture cannot be read back");
  const values = new format.values(width * height * 4);
  gl.readPixels(0, 0, width, height, gl.RGBA, format.type, values);
  if (gl.getError() !== gl.NO_ERROR) throw new Error("WebGL error while reading back");
  return values;
}

async function bitmapOf(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status}`);
  return createImageBitmap(await answer.blob(), OPTIONS);
}

/** {width, height, values}: the texels of the picture at `url`, RGBA, row 0 first. */
window.readBack = async (url, kind) => {
  const gl = newContext();
  const format = FORMATS[kind](gl);
  const bitmap = await bitmapOf(url);
  const texture = textureOf(gl, bitmap, format);
  const values = readTexture(gl, texture, bitmap.width, bitmap.height, format);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return { width: bitmap.width, height: bitmap.height, values: Array.from(values) };
};

/** What WebCodecs gives: {format, width, height, planes}, 8- or 16-bit numbers, or null without it. */
window.decodeFrame = async (url, type) => {
  if (!window.ImageDecoder) return null;
  const { body } = await fetch(url);
  const { image } = await new ImageDecoder({ data: body, type, ...OPTIONS }).decode();
  const bytes = new Uint8Array(image.allocationSize());
  const layout = await image.copyTo(bytes);
  const Numbers = /P1\d$/.test(image.format) ? Uint16Array : Uint8Array;
  const { codedWidth: width, codedHeight: height } = image;
  const planes = layout.map(({ offset, stride }) => {
    const numbers = new Numbers(bytes.buffer, offset);
    const step = stride / Numbers.BYTES_PER_ELEMENT;
    return Array.from({ length: width * height },
                      (_, i) => numbers[Math.floor(i / width) * step + (i % width)]);
  });
  return { format: image.format, width, height, planes };
};

// Parts of shaders that several of them use.

/** How places are read from the quantized vertices: `place` is a corner in steps of its chunk, and the chunk. */
export const PLACES = /* glsl */ `
in uvec4 place;
uniform mat4 viewMatrix, projectionMatrix;
uniform highp sampler2D uChunks;
uniform uint uFirstChunk;
vec4 chunkTexel(int i) { return texelFetch(uChunks, ivec2(i & 1023, i >> 10), 0); }
`;

export const CODES = /* glsl */ `
vec3 rgb9e5(uint code) {
  vec3 mantissa = vec3(uvec3(code, code >> 9u, code >> 18u) & 511u);
  // Two to the power of the exponent less 24, put together from its bits.
  return mantissa * uintBitsToFloat(((code >> 27u) + 103u) << 23u);
}
const vec3 GREY = vec3(0.2126, 0.7152, 0.0722);
`;

/** From luminance to the codes of the display. */
export const DISPLAY = /* glsl */ `
uniform highp sampler2D uToneRow;
uniform vec3 uToneAt;     // first column, columns to a doubling, number of columns
uniform float uWhite;
uniform mat3 uBalance;     // as eyes adapt to the colour of the light
uniform bool uToneOnChannels;
float tone(float exposed) {
  if (!(exposed > 0.0)) return 0.0;
  float at = (log2(exposed) - uToneAt.x) * uToneAt.y;
  float k = clamp(floor(at), 0.0, uToneAt.z - 2.0);
  float a = texelFetch(uToneRow, ivec2(int(k), 0), 0).r;
  float b = texelFetch(uToneRow, ivec2(int(k) + 1, 0), 0).r;
  return exp2(a + (at - k) * (b - a));
}
vec3 srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}
vec3 display(vec3 luminance) {
  vec3 exposed = uBalance * luminance / uWhite;
  if (uToneOnChannels) return srgb(vec3(tone(exposed.r), tone(exposed.g), tone(exposed.b)));
  float y = dot(exposed, GREY);
  return y > 0.0 ? srgb(exposed * (tone(y) / y)) : vec3(0.0);
}
`;

/** False colour: a step of 256, never one between. */
export const FALSE_COLOUR = /* glsl */ `
uniform sampler2D uColours;
uniform vec2 uLimits;
uniform bool uLogarithmic;
vec3 falseColour(float value) {
  float position = uLogarithmic
    ? (value > 0.0 ? log(value / uLimits.x) / log(uLimits.y / uLimits.x) : 0.0)
    : (value - uLimits.x) / (uLimits.y - uLimits.x);
  return texelFetch(uColours, ivec2(int(clamp(floor(position * 256.0), 0.0, 255.0)), 0), 0).rgb;
}
`;

// Shaders of surfaces: luminance or false colour from the light of vertices.

import { CODES, DISPLAY, FALSE_COLOUR, PLACES } from './shader-common';

export const SURFACE_VERTEX = /* glsl */ `
precision highp float;
precision highp int;
${PLACES}
${CODES}
in vec4 normal;
in uvec3 light, light2;
uniform highp sampler2D uFinishes;
uniform int uMode, uSide;
out vec4 vTotal;          // illuminance in three channels and 1, times whether it is known
out vec2 vValue;          // what false colour shows and 1, times whether it is known
flat out vec4 vDiffuse;   // diffuse reflectance; whether there is light
flat out vec3 vEmission;
#ifdef TEXTURED
in vec2 uv;
out vec2 vUv;
#endif
#ifdef REFLECTS
out vec3 vNormal, vPlace;
flat out vec4 vMirror, vGloss;
flat out vec2 vCoat;
#endif
#ifdef PLANE
uniform mat4 uReflectionMatrix;
out vec4 vReflected;
#endif
#ifdef GLASS
out vec3 vNormal, vPlace;
flat out vec4 vGlass;
#endif

vec4 finishTexel(int i) { return texelFetch(uFinishes, ivec2(i & 1023, i >> 10), 0); }
bool isKnown(uint code) { return (code & 0x7fffu) <= 0x7c00u; }
bool isFinite(uint code) { return (code & 0x7fffu) < 0x7c00u; }
vec3 unitNormal(vec2 n) {
  vec3 v = vec3(n, 1.0 - abs(n.x) - abs(n.y));
  if (v.z < 0.0) v.xy = (1.0 - abs(v.yx)) * vec2(v.x < 0.0 ? -1.0 : 1.0, v.y < 0.0 ? -1.0 : 1.0);
  return normalize(v);
}

void shade(uvec3 own, uvec3 other) {
  vec3 direct = rgb9e5(own.x), indirect = rgb9e5(own.y);
  float known = isKnown(own.z) ? 1.0 : 0.0;
  vTotal = vec4(direct + indirect, 1.0) * known;
  vValue = vec2(dot(vTotal.rgb, GREY), known);
  if (uMode == 3) vValue.x = dot(direct, GREY) * known;
  if (uMode == 4) vValue.x = dot(indirect, GREY) * known;
  if (uMode == 5 || uMode == 6) vValue = isFinite(own.z) ? vec2(unpackHalf2x16(own.z).x, 1.0) : vec2(0.0);
  if (uMode == 7) {
    known *= isKnown(other.z) ? 1.0 : 0.0;
    vValue = vec2(dot(direct + indirect - rgb9e5(other.x) - rgb9e5(other.y), GREY), 1.0) * known;
  }
}

void main() {
  int chunk = int(uFirstChunk + place.w);
  vec4 low = chunkTexel(2 * chunk), size = chunkTexel(2 * chunk + 1);
  int finish = 5 * int(low.w);
  vec3 at = low.xyz + size.xyz * vec3(place.xyz);
  vec4 eye = viewMatrix * vec4(at, 1.0);
  vDiffuse = vec4(finishTexel(finish).rgb, size.w);
  vEmission = finishTexel(finish + 3).rgb;
  if (uSide == 1) shade(light2, light); else shade(light, light2);
  // Without known light is what lies behind or inside of something: it recedes, or from afar it would show through what covers it.
  if (size.w > 0.5 && vTotal.a < 0.5) eye.xyz *= 1.002;
  gl_Position = projectionMatrix * eye;
#ifdef TEXTURED
  vUv = uv;
#endif
#ifdef REFLECTS
  vNormal = unitNormal(normal.xy / 127.0);
  vPlace = at;
  vMirror = finishTexel(finish + 1);
  vGloss = finishTexel(finish + 2);
  vCoat = vec2(vGloss.w, finishTexel(finish + 3).w);
  vGloss.w = vMirror.w;
#endif
#ifdef PLANE
  vReflected = uReflectionMatrix * vec4(at, 1.0);
#endif
#ifdef GLASS
  vNormal = unitNormal(normal.xy / 127.0);
  vPlace = at;
  vGlass = finishTexel(finish + 4);
#endif
}
`;

/** What mirrors and facets show: planes what was drawn for them, all else the surroundings. */
const REFLECTION = /* glsl */ `
uniform samplerCube uSurroundings;
uniform vec3 uCentre, uRoomLow, uRoomHigh, uAmbient, cameraPosition;
uniform float uCubeSize;   // 0: there is none yet
// Where a ray from a place leaves the room, seen from the centre of the surroundings.
vec3 inRoom(vec3 place, vec3 way) {
  vec3 t = max((uRoomLow - place) / way, (uRoomHigh - place) / way);
  return place + way * max(0.0, min(t.x, min(t.y, t.z))) - uCentre;
}
vec3 surroundings(vec3 place, vec3 way, float alpha) {
  if (uCubeSize < 1.0) return uAmbient;
  vec3 from = inRoom(place, way);
  return textureLod(uSurroundings, from, max(0.0, log2(1.3 * uCubeSize * alpha))).rgb;
}
float power5(float c) { float d = c * c; return d * d * c; }
`;

const OPAQUE_REFLECTION = /* glsl */ `
#ifdef REFLECTS
${REFLECTION}
in vec3 vNormal, vPlace;
flat in vec4 vMirror, vGloss;
flat in vec2 vCoat;
#ifdef PLANE
uniform sampler2D uReflection;
uniform float uIsReflected;
in vec4 vReflected;
#endif
vec3 reflected(vec3 way, float alpha) {
#ifdef PLANE
  if (uIsReflected > 0.5 && alpha < 0.02) return textureProj(uReflection, vReflected.xyw).rgb;
#endif
  return surroundings(vPlace, way, alpha);
}
// Mirror, gloss by Schlick, and a clear coat; no more than diffuse light leaves.
vec3 reflections(vec3 diffuse) {
  vec3 view = normalize(vPlace - cameraPosition), n = normalize(vNormal);
  float c5 = power5(1.0 - clamp(-dot(view, n), 0.0, 1.0));
  vec3 way = reflect(view, n), room = max(vec3(0.0), 1.0 - diffuse - vMirror.rgb);
  float coat = min(vCoat.x * (0.04 + (max(1.0 - vCoat.y, 0.04) - 0.04) * c5), min(room.r, min(room.g, room.b)));
  vec3 edge = max(vec3(1.0 - vGloss.w), vGloss.rgb);
  vec3 gloss = dot(vGloss.rgb, vec3(1.0)) > 0.0 ? min((vGloss.rgb + (edge - vGloss.rgb) * c5) * (1.0 - coat) * (1.0 - coat), room - coat) : vec3(0.0);
  vec3 sum = vec3(0.0);
  if (dot(vMirror.rgb, vec3(1.0)) > 0.0) sum += vMirror.rgb * reflected(way, 0.0);
  if (dot(gloss, vec3(1.0)) > 0.0) sum += gloss * reflected(way, vGloss.w);
  if (coat > 0.0) sum += coat * reflected(way, vCoat.y);
  return sum;
}
#endif
`;

export const SURFACE_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
${CODES}
${DISPLAY}
${FALSE_COLOUR}
in vec4 vTotal;
in vec2 vValue;
flat in vec4 vDiffuse;
flat in vec3 vEmission;
uniform int uMode;        // 0 seen, 1 illuminance, 2 luminance, 3 direct, 4 indirect, 5 error, 6 relative, 7 difference
uniform int uOutput;      // 0 the display, 1 luminance and illuminance, 2 false colour without marks, 3 as 1, luminaires below zero
uniform int uTickCount;   // of isolux lines
uniform float uTicks[24];
uniform float uPixels;    // device pixels of a line
out vec4 colour;
#ifdef TEXTURED
uniform sampler2D uTexture;
in vec2 vUv;
#endif
${OPAQUE_REFLECTION}

vec3 luminance() {
  vec3 diffuse = vDiffuse.rgb;
#ifdef TEXTURED
  diffuse *= texture(uTexture, vUv).rgb;
#endif
  vec3 light = vTotal.a > 1e-3 ? vTotal.rgb / vTotal.a : vec3(0.0);
  vec3 sum = diffuse * light * 0.3183098862 + vEmission;
#ifdef REFLECTS
  sum += reflections(vDiffuse.rgb);
#endif
  return sum;
}

vec3 hatch() {
  float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / (8.0 * uPixels));
  return vec3(stripe < 0.5 ? 0.33 : 0.42);
}

vec3 inFalseColour() {
  if (vDiffuse.a < 0.5) {
#ifdef PLANE
    if (uOutput == 0 && uIsReflected > 0.5) return textureProj(uReflection, vReflected.xyw).rgb;
#endif
    return vec3(0.16);
  }
  if (vTotal.a < 1e-3 || vValue.y < 1e-3) return hatch();
  float value = vValue.x / vValue.y;
  if (uMode == 6) value *= 100.0 * vTotal.a / max(1e-9, dot(vTotal.rgb, GREY));
  return falseColour(value);
}

// Lines where illuminance has round values; white with a dark rim.
vec3 withLines(vec3 below, float lux, float slope) {
  float nearest = 1e9, next = 1e9;
  for (int i = 0; i < 24; i++) {
    if (i >= uTickCount) break;
    float off = abs(lux - uTicks[i]);
    next = min(next, max(off, nearest));
    nearest = min(nearest, off);
  }
  float pixel = 1.0 / max(slope, 1e-9) / uPixels;
  // Where lines would cover all, there are none.
  float clear = smoothstep(4.0, 9.0, (nearest + next) * pixel);
  vec3 rim = mix(below, vec3(0.0), clear * 0.5 * (1.0 - smoothstep(0.8, 2.0, nearest * pixel)));
  return mix(rim, vec3(1.0), clear * (1.0 - smoothstep(0.35, 1.1, nearest * pixel)));
}

void main() {
  bool isLit = vDiffuse.a > 0.5 && vTotal.a > 1e-3;
  float lux = isLit ? dot(vTotal.rgb, GREY) / vTotal.a : -1.0;
  if (uOutput == 1 || uOutput == 3) {
    bool isLuminaire = uOutput == 3 && dot(vEmission, GREY) > 0.0;
    colour = vec4(isLuminaire ? -luminance() : luminance(), lux);
    return;
  }
  vec3 shown;
  if (uMode == 0) shown = display(luminance());
  else if (uMode == 2) shown = vDiffuse.a > 0.5 && !isLit ? hatch() : falseColour(dot(luminance(), GREY));
  else shown = inFalseColour();
  if (uTickCount > 0 && uOutput == 0) {
    float slope = length(vec2(dFdx(lux), dFdy(lux)));
    if (isLit) shown = withLines(shown, lux, slope);
  }
  colour = vec4(shown, 1.0);
}
`;

/** A pane, drawn twice: PASS 0 multiplies what is behind, PASS 1 adds what is reflected. */
export const GLASS_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
${CODES}
${DISPLAY}
${REFLECTION}
in vec3 vNormal, vPlace;
flat in vec4 vGlass;
uniform int uMode, uOutput;
out vec4 colour;

void main() {
  vec3 view = normalize(vPlace - cameraPosition), n = normalize(vNormal);
  float f0 = (vGlass.w - 1.0) / (vGlass.w + 1.0);
  f0 *= f0;
  float r = f0 + (1.0 - f0) * power5(1.0 - clamp(-dot(view, n), 0.0, 1.0));
  // All inner reflections of a pane summed. What slants in the glass goes a longer way; an index of one is that of a film.
  float c = clamp(-dot(view, n), 0.0, 1.0), inside = sqrt(max(0.01, 1.0 - (1.0 - c * c) / (vGlass.w * vGlass.w)));
  vec3 t = vGlass.w == 1.0 ? vGlass.rgb : pow(vGlass.rgb, vec3(1.0 / inside)), all = (1.0 - r) * (1.0 - r) / (1.0 - r * r * t * t);
  bool isLuminance = uOutput == 1 || uOutput == 3, isSeen = isLuminance || uMode == 0;
#if PASS == 0
  vec3 through = t * all;
  if (!isSeen) colour = vec4(1.0);
  // Codes of the display are about the power 1 / 2.2 of light.
  else colour = vec4(isLuminance ? through : pow(through, vec3(1.0 / 2.2)), 1.0);
#else
  vec3 luminance = (r + r * t * t * all) * surroundings(vPlace, reflect(view, n), 0.0);
  if (!isSeen) colour = vec4(vec3(0.03), 1.0);
  else colour = vec4(isLuminance ? luminance : display(luminance), 1.0);
#endif
}
`;

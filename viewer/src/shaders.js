// Shaders of the surfaces of regions, of their cut faces, and of lines and points.

/** Defines: CUT where there is a section, INSIDE in the pass of faces seen from inside. The state of a region is a texel with its colour and, in alpha, how it is drawn. */
const regionLookup = /* glsl */ `
uniform sampler2D states;   // RGBA: colour and state
uniform sampler2D offsets;  // RGBA: displacement of the exploded view
uniform float explode;
ivec2 texel(float label) {
    int width = textureSize(states, 0).x;
    return ivec2(int(label) % width, int(label) / width);
}
vec4 stateOf(float label) { return texelFetch(states, texel(label), 0); }
vec3 offsetOf(float label) { return explode * texelFetch(offsets, texel(label), 0).xyz; }
`;

export const surfaceVertex = /* glsl */ `
in vec2 labels;  // of the region, and of the other side
in float value;
uniform float wantedState;
uniform float stretch;  // of z
centroid out vec3 place;  // outside thin faces it would be on the wrong side of a section
out vec3 spot;
out vec3 shade;
out vec3 corner;
out float amount;
out float known;
flat out vec2 sides;
flat out vec3 colour;
${regionLookup}
void main() {
    vec4 state = stateOf(labels.x);
    sides = labels;
    colour = state.rgb;
    known = value < 1e29 ? 1.0 : 0.0;  // 1e30 means none
    amount = known * value;
    shade = normalMatrix * vec3(normal.xy, normal.z / stretch);
    int turn = gl_VertexID % 3;
    corner = vec3(turn == 0, turn == 1, turn == 2);
    place = (position + offsetOf(labels.x)) * vec3(1.0, 1.0, stretch);
    spot = place;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
    if (abs(state.a - wantedState) > 0.1) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside the picture
}
`;

export const surfaceFragment = /* glsl */ `
precision highp float;
centroid in vec3 place;
in vec3 spot;
in vec3 shade;
in vec3 corner;
in float amount;          // values of the corners that have one, weighted
in float known;           // the sum of their weights
flat in vec2 sides;
flat in vec3 colour;
uniform vec4 plane;       // keeps the points with dot(plane.xyz, p) <= plane.w
uniform bool isFlat;
uniform bool isGhost;
uniform float edges;      // width of the edges of faces in pixels, 0: none
uniform int mode;         // 0 region, 1 interface, 2 value
uniform vec2 range;
uniform sampler2D ramp;
uniform float selected;
uniform vec3 eye;
uniform bool isOutside;  // the camera is outside, and regions are closed
out vec4 result;

vec3 interfaceColour(vec2 pair) {
    float low = min(pair.x, pair.y), high = max(pair.x, pair.y);
    float hue = fract(low * 0.61803398875 + high * 0.7548776662);
    float light = 0.62 + 0.3 * fract(low * 0.3819 + high * 0.5698);
    return light * clamp(abs(fract(hue + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 0.6, 0.12, 1.0);
}

vec3 baseColour() {
    if (mode == 1) return interfaceColour(sides);
    if (mode == 2) {
        if (known < 0.5) return vec3(0.55);
        float x = clamp((amount / known - range.x) / (range.y - range.x), 0.0, 1.0);
        return texture(ramp, vec2(x * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
    }
    return colour;
}

/** The selected region is lighter. Values keep the colours of the legend: lines, white beside black, mark it there. */
vec3 marked(vec3 base, bool isValue) {
    if (sides.x != selected) return base;
    if (!isValue) return mix(base, vec3(1.0), 0.35);
    float across = mod(gl_FragCoord.x + gl_FragCoord.y, 18.0);
    return across < 1.0 ? vec3(1.0) : across < 2.0 ? vec3(0.0) : base;
}

#ifdef INSIDE
/**
 * Back faces of a cut region fill its section: where a ray enters a region through the plane, the next surface that it
 * meets is the boundary of this region, from inside.
 */
void drawInside() {
    bool isCap = false;
#ifdef CUT
    vec3 ray = place - eye;
    float t = (plane.w - dot(plane.xyz, eye)) / dot(plane.xyz, ray);
    isCap = t > 0.0 && t <= 1.0;
    if (!isCap && isOutside) discard;
#endif
    vec3 base = marked(mode == 2 ? colour : baseColour(), false);  // values are those of the surface
    result = vec4(isCap ? mix(base, vec3(1.0), 0.12) : 0.45 * base, 1.0);
}
#endif

void main() {
#ifdef CUT
    if (dot(plane.xyz, place) > plane.w) discard;
#endif
#ifdef INSIDE
    drawInside();
    return;
#endif
    vec3 n = normalize(shade);
    vec3 view = normalize((viewMatrix * vec4(place - eye, 0.0)).xyz);
    if (isFlat) {
        vec3 p = (viewMatrix * vec4(spot, 1.0)).xyz;
        n = normalize(cross(dFdx(p), dFdy(p)));
    }
    float facing = abs(dot(n, view));
    vec3 base = marked(baseColour(), mode == 2);
    if (isGhost) {
        result = vec4(base, 0.10 + 0.35 * (1.0 - facing) * (1.0 - facing));
        return;
    }
    vec3 light = normalize(vec3(0.3, 0.5, 1.0));
    float lit = 0.50 + 0.38 * max(dot(n, light), 0.0) + 0.18 * facing;
    vec3 shown = base * lit + 0.06 * pow(max(dot(n, light), 0.0), 24.0);
    if (edges > 0.0) {
        vec3 width = fwidth(corner);
        vec3 near = smoothstep(vec3(0.0), width * edges, corner);
        shown *= mix(0.35, 1.0, min(near.x, min(near.y, near.z)));
    }
    result = vec4(shown, 1.0);
}
`;

/** Lines and points on top of the surfaces, cut like them. */
export const overlayVertex = /* glsl */ `
uniform float size;
uniform float stretch;
out vec3 place;
void main() {
    place = position * vec3(1.0, 1.0, stretch);
    vec4 seen = modelViewMatrix * vec4(place, 1.0);
    gl_Position = projectionMatrix * vec4(0.9985 * seen.xyz, 1.0);  // nearer, at the same place of the picture
    gl_PointSize = size;
}
`;

export const overlayFragment = /* glsl */ `
precision highp float;
in vec3 place;
uniform vec3 tint;
uniform vec4 plane;
uniform bool isCut;
uniform bool isRound;
out vec4 result;
void main() {
    if (isCut && dot(plane.xyz, place) > plane.w) discard;
    if (isRound && length(gl_PointCoord - 0.5) > 0.5) discard;
    result = vec4(tint, 1.0);
}
`;

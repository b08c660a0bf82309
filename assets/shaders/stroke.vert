// A line, or an arrow, as a rectangle on the screen around its axis.
uniform mat4 viewMatrix;
uniform mat4 projection;
uniform vec2 viewportPx;
uniform float pull; // towards the eye, over the distance: keeps lines on a surface in front of it

in vec4 fromWidth; // width in pixels
in vec4 toHead;    // length of the head in pixels, 0 for a line
in vec4 color;

out vec2 place;       // pixels along the axis and across
flat out vec3 extent; // length, half width, length of the head
flat out vec4 tint;

vec3 deviceFromEye(vec3 eye) {
    bool perspective = projection[3][3] == 0.0;
    vec4 clip = projection * vec4(perspective ? eye * (1.0 - pull) : eye + vec3(0, 0, 2.0 * pull / projection[1][1]), 1.0);
    return clip.xyz / clip.w;
}

void main() {
    const vec2 CORNERS[6] = vec2[6](vec2(0, -1), vec2(1, -1), vec2(1, 1), vec2(0, -1), vec2(1, 1), vec2(0, 1));
    vec2 corner = CORNERS[gl_VertexID];
    vec3 a = (viewMatrix * vec4(fromWidth.xyz, 1.0)).xyz;
    vec3 b = (viewMatrix * vec4(toHead.xyz, 1.0)).xyz;
    if (projection[3][3] == 0.0) {
        float nearest = 0.501 * projection[3][2]; // −near: the last column holds −2 near
        if (a.z > nearest && b.z > nearest) {
            gl_Position = vec4(2, 2, 2, 1);
            return;
        }
        if (a.z > nearest) a = mix(a, b, (a.z - nearest) / (a.z - b.z));
        if (b.z > nearest) b = mix(b, a, (b.z - nearest) / (b.z - a.z));
    }
    vec3 deviceA = deviceFromEye(a);
    vec3 deviceB = deviceFromEye(b);
    vec2 pxA = 0.5 * deviceA.xy * viewportPx;
    vec2 pxB = 0.5 * deviceB.xy * viewportPx;
    float len = distance(pxA, pxB);
    vec2 axis = len > 1e-3 ? (pxB - pxA) / len : vec2(1, 0);
    float head = min(toHead.w, 0.6 * len);
    float halfWidth = 0.5 * fromWidth.w;
    float reach = max(halfWidth, 0.5 * head) + 2.0;
    place = vec2(mix(-2.0, len + 2.0, corner.x), corner.y * reach);
    extent = vec3(len, halfWidth, head);
    tint = color;
    vec2 px = pxA + axis * place.x + vec2(-axis.y, axis.x) * place.y;
    float z = mix(deviceA.z, deviceB.z, clamp(place.x / max(len, 1e-3), 0.0, 1.0));
    // Divided already: `place` must run evenly over the screen.
    gl_Position = vec4(2.0 * px / viewportPx, z, 1.0);
}

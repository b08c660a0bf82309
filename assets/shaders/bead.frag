// As sphere.frag shades it seen from far away, flat in depth: what is hidden is then known before it is shaded.
uniform vec3 skyward; // world up, in eye coordinates

flat in vec4 bodyTint;
flat in vec4 ringTint;
layout(location = 0) out vec4 outColor;

const vec3 KEY_LIGHT = normalize(vec3(-0.45, 0.62, 0.64));
const vec3 HALFWAY = normalize(KEY_LIGHT + vec3(0, 0, 1));

void main() {
    vec2 at = (2.0 * gl_PointCoord - 1.0) * vec2(bodyTint.a, -bodyTint.a);
    float off = dot(at, at);
    if (off > ringTint.a) discard;
    float facing = sqrt(max(1.0 - off, 0.0));
    vec3 normal = vec3(at, facing);
    float key = max(dot(normal, KEY_LIGHT), 0.0);
    float sky = 0.5 + 0.5 * dot(normal, skyward);
    float shine = max(dot(normal, HALFWAY), 0.0);
    float shine2 = shine * shine;
    float shine8 = shine2 * shine2 * shine2 * shine2;
    float shine32 = shine8 * shine8 * shine8 * shine8;
    vec3 body = bodyTint.rgb * (0.30 + 0.24 * sky + 0.52 * key) + 0.22 * shine8 * shine32;
    body *= mix(0.55, 1.0, smoothstep(0.0, 0.42, facing));
    outColor = vec4(off > 1.0 ? ringTint.rgb : body, 1.0);
}

uniform mat4 projection;
uniform vec3 skyward;

in vec3 eyePlace;
flat in vec3 eyeNormal;
flat in vec4 tint;
layout(location = 0) out vec4 outColor;

const vec3 KEY_LIGHT = vec3(-0.45, 0.62, 0.64);

void main() {
    bool perspective = projection[3][3] == 0.0;
    vec3 ray = perspective ? normalize(eyePlace) : vec3(0, 0, -1);
    vec3 normal = dot(eyeNormal, ray) > 0.0 ? -eyeNormal : eyeNormal;
    float key = max(dot(normal, normalize(KEY_LIGHT)), 0.0);
    float sky = 0.5 + 0.5 * dot(normal, skyward);
    outColor = vec4(tint.rgb * (0.60 + 0.16 * sky + 0.27 * key), tint.a);
}

uniform mat4 projection;
uniform vec3 skyward; // world up, in eye coordinates

in vec3 eyePlace;
flat in vec4 eyeSphere;
flat in vec4 bodyTint;
flat in vec4 ringTint;
flat in vec2 ringSizeHatch;
flat in float pixelSize;
layout(location = 0) out vec4 outColor;

const vec3 KEY_LIGHT = vec3(-0.45, 0.62, 0.64); // from over the viewer's left shoulder

void main() {
    bool perspective = projection[3][3] == 0.0;
    vec3 origin = perspective ? vec3(0.0) : vec3(eyePlace.xy, 0.0);
    vec3 ray = perspective ? normalize(eyePlace) : vec3(0, 0, -1);
    vec3 toCenter = eyeSphere.xyz - origin;
    float along = dot(toCenter, ray);
    // Distance of the ray from the centre, as a rejection: differences of squares would lose the silhouette.
    float off = length(toCenter - ray * along);
    float radius = eyeSphere.w;
    float ring = ringSizeHatch.x;

    float covered = clamp(0.5 + (radius + ring - off) / pixelSize, 0.0, 1.0);
    if (covered <= 0.0) discard;

    float halfChord = sqrt(max(radius * radius - off * off, 0.0));
    vec3 hit = origin + ray * (along - halfChord);
    if (perspective && along - halfChord < 0.0) discard;
    vec3 normal = normalize(hit - eyeSphere.xyz);
    float facing = clamp(-dot(normal, ray), 0.0, 1.0);

    float key = max(dot(normal, normalize(KEY_LIGHT)), 0.0);
    float sky = 0.5 + 0.5 * dot(normal, skyward);
    vec3 body = bodyTint.rgb * (0.30 + 0.24 * sky + 0.52 * key);
    if (ringSizeHatch.y > 0.0) {
        // Fixed: matt and hatched, the lines stay with the body.
        vec2 place = (hit - eyeSphere.xyz).xy / pixelSize;
        float stripe = abs(fract((place.x + place.y) / ringSizeHatch.y) - 0.5);
        body *= mix(0.78, 1.0, smoothstep(0.10, 0.19, stripe));
    } else {
        vec3 halfway = normalize(normalize(KEY_LIGHT) - ray);
        body += 0.22 * pow(max(dot(normal, halfway), 0.0), 40.0);
    }
    // A darker rim sets bodies of the same colour apart.
    body *= mix(0.55, 1.0, smoothstep(0.0, 0.42, facing));

    float inBody = clamp(0.5 + (radius - off) / pixelSize, 0.0, 1.0);
    vec3 color = ring > 0.0 ? mix(ringTint.rgb, body, inBody) : body;
    vec4 clip = projection * vec4(hit, 1.0);
    gl_FragDepth = clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);
    outColor = vec4(color, covered);
}

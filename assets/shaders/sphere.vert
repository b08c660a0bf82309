// A sphere as one rectangle that just covers its silhouette and ring; the fragment shader casts the rays.
uniform mat4 viewMatrix;
uniform mat4 projection;
uniform vec2 viewportPx;

in vec4 centerRadius;
in vec4 color;
in vec4 ringColor;
in vec2 ringHatch; // ring width and distance of hatching lines in pixels, 0 = none

out vec3 eyePlace;
flat out vec4 eyeSphere;
flat out vec4 bodyTint;
flat out vec4 ringTint;
flat out vec2 ringSizeHatch; // ring width in metres at the centre, distance of hatching lines in pixels
flat out float pixelSize;    // metres per pixel at the centre

void main() {
    const vec2 CORNERS[6] = vec2[6](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    vec2 corner = CORNERS[gl_VertexID];
    bool perspective = projection[3][3] == 0.0;
    vec3 center = (viewMatrix * vec4(centerRadius.xyz, 1.0)).xyz;
    float depth = perspective ? length(center) : 1.0;
    pixelSize = 2.0 * depth / (projection[1][1] * viewportPx.y);
    float ring = ringHatch.x * pixelSize;
    float radius = centerRadius.w + ring + pixelSize;
    vec3 right = vec3(1, 0, 0);
    vec3 up = vec3(0, 1, 0);
    float reach = radius;
    if (perspective) {
        // The cone from the eye around the sphere cuts the plane through its centre, that faces the eye,
        // in a circle of radius r D / sqrt(D² − r²).
        vec3 toEye = -center / depth;
        right = normalize(cross(abs(toEye.y) < 0.99 ? vec3(0, 1, 0) : vec3(1, 0, 0), toEye));
        up = cross(toEye, right);
        reach = radius * depth / sqrt(max(depth * depth - radius * radius, 1e-4 * radius * radius));
    }
    eyePlace = center + (right * corner.x + up * corner.y) * reach;
    eyeSphere = vec4(center, centerRadius.w);
    bodyTint = color;
    ringTint = ringColor;
    ringSizeHatch = vec2(ring, ringHatch.y);
    gl_Position = projection * vec4(eyePlace, 1.0);
}

in vec2 place;
flat in vec2 sizeShape;
flat in vec4 tint;
layout(location = 0) out vec4 outColor;

void main() {
    float size = sizeShape.x;
    int shape = int(sizeShape.y + 0.5); // 0 disc, 1 ring, 2 diamond, 3 square, 4 cross
    vec2 q = abs(place);
    float inside; // signed distance in pixels, positive inside
    if (shape == 0) inside = size - length(place);
    else if (shape == 1) inside = 1.1 - abs(size - 1.1 - length(place));
    else if (shape == 2) inside = (size - q.x - q.y) * 0.7071;
    else if (shape == 3) inside = 0.8 * size - max(q.x, q.y);
    else inside = min(1.2 - abs(q.x - q.y) * 0.7071, size - max(q.x, q.y));
    float covered = clamp(inside + 0.5, 0.0, 1.0);
    // A seam sets markers off from bodies of any colour.
    float seam = 0.75 * clamp(inside + 1.7, 0.0, 1.0);
    if (max(covered, seam) <= 0.0) discard;
    float brightness = dot(tint.rgb, vec3(0.3, 0.59, 0.11));
    vec3 seamColor = vec3(brightness > 0.5 ? 0.07 : 0.97);
    outColor = vec4(mix(seamColor, tint.rgb, covered), tint.a * max(covered, seam));
}

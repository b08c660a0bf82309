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
    // A dark seam sets filled markers off from what is behind them.
    bool filled = shape == 0 || shape == 2 || shape == 3;
    float seam = filled ? clamp(inside + 1.8, 0.0, 1.0) : covered;
    if (seam <= 0.0) discard;
    outColor = vec4(mix(vec3(0.06), tint.rgb, covered), tint.a * max(covered, 0.6 * seam));
}

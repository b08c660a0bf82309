in vec2 place;
flat in vec3 extent;
flat in vec4 tint;
layout(location = 0) out vec4 outColor;

void main() {
    float len = extent.x;
    float head = extent.z;
    float across = abs(place.y);
    // Signed distances in pixels, positive inside: the shaft, and a head half as wide as long on each side.
    float shaft = min(extent.y - across, min(place.x + 0.5, len - head - place.x + 0.5));
    float tip = head > 0.0 ? min((len - place.x) * 0.42 - across, place.x - (len - head)) : -1.0;
    float covered = clamp(max(shaft, tip) + 0.5, 0.0, 1.0);
    // Thinner than a pixel: fainter, not broken.
    covered *= min(2.0 * extent.y, 1.0) / min(max(2.0 * extent.y, 0.5), 1.0);
    if (covered <= 0.0) discard;
    outColor = vec4(tint.rgb, tint.a * covered);
}

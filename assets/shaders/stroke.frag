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
    // A seam around arrows sets them off from bodies of any colour.
    float seam = head > 0.0 ? 0.75 * clamp(max(shaft, tip) + 1.7, 0.0, 1.0) : 0.0;
    if (max(covered, seam) <= 0.0) discard;
    float brightness = dot(tint.rgb, vec3(0.3, 0.59, 0.11));
    vec3 seamColor = vec3(brightness > 0.5 ? 0.07 : 0.97);
    outColor = vec4(seam > 0.0 ? mix(seamColor, tint.rgb, covered) : tint.rgb, tint.a * max(covered, seam));
}

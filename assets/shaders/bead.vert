// A ball of a draft as one point: its place on the screen is known already.
in vec4 placeRadius; // device coordinates, radius in pixels
in vec4 color;
in vec4 ringColor; // its alpha is the width of the ring in pixels

flat out vec4 bodyTint; // its alpha is half the point over the radius
flat out vec4 ringTint; // its alpha is the square of body and ring over the radius

void main() {
    // No smaller than that, or it would fall between the pixels.
    float radius = max(placeRadius.w, 0.75);
    float reach = radius + ringColor.a;
    bodyTint = vec4(color.rgb, reach / radius);
    ringTint = vec4(ringColor.rgb, reach * reach / (radius * radius));
    gl_PointSize = 2.0 * reach;
    gl_Position = vec4(placeRadius.xyz, 1.0);
}

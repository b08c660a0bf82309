// A triangle that covers the view; `height` goes from 0 at the bottom to 1 at the top.
in vec4 topColor;
in vec4 bottomColor;

out float height;
flat out vec4 top;
flat out vec4 bottom;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    top = topColor;
    bottom = bottomColor;
    height = 0.5 * corner.y + 0.5;
    gl_Position = vec4(corner, 1.0, 1.0);
}

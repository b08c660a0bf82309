// A marker of constant size on the screen.
uniform mat4 viewMatrix;
uniform mat4 projection;
uniform vec2 viewportPx;

in vec4 positionSize; // size in pixels
in vec4 color;
in vec2 shape;

out vec2 place; // pixels from the middle
flat out vec2 sizeShape;
flat out vec4 tint;

void main() {
    const vec2 CORNERS[6] = vec2[6](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
    vec4 clip = projection * (viewMatrix * vec4(positionSize.xyz, 1.0));
    place = CORNERS[gl_VertexID] * (0.5 * positionSize.w + 2.0);
    sizeShape = vec2(0.5 * positionSize.w, shape.x);
    tint = color;
    gl_Position = vec4(clip.xy + 2.0 * place / viewportPx * clip.w, clip.z, clip.w);
}

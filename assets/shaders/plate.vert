uniform mat4 viewMatrix;
uniform mat4 projection;

in vec3 corner;
in vec3 edgeX;
in vec3 edgeY;
in vec4 color;

out vec3 eyePlace;
flat out vec3 eyeNormal;
flat out vec4 tint;

void main() {
    const vec2 CORNERS[6] = vec2[6](vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 0), vec2(1, 1), vec2(0, 1));
    vec2 at = CORNERS[gl_VertexID];
    eyePlace = (viewMatrix * vec4(corner + edgeX * at.x + edgeY * at.y, 1.0)).xyz;
    // Normalised first: the cross product of tiny edges would underflow.
    eyeNormal = mat3(viewMatrix) * normalize(cross(normalize(edgeX), normalize(edgeY)));
    tint = color;
    gl_Position = projection * vec4(eyePlace, 1.0);
}

out int number;

void main() { number = gl_VertexID; }

// Depth comes from the vertices.
void main()
{
}

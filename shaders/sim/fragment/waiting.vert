layout(location = 0) in uint listed; // index + 1
out uint candidate;

void main() { candidate = listed; }

"""The Petrusevich spike: where it stands, meshes about it, what they say."""

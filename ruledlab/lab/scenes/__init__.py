"""What the lessons' apps show, without widgets: values, what follows from them, pictures, words."""

"""The Moon, its landing sites, and terminal guidance. Kernel functions."""
